"""Kernel functions that turn a G-buffer into light: reflectance and tone."""
