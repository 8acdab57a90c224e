"""Kernel to target text: the last step before a machine sees an algorithm.

``target`` says what a CPU offers, ``llvm`` turns a kernel into LLVM IR for it. Nothing here runs code: that is
``runtime``. The text is made without LLVM, so a machine that finds its object code on disk never loads it.
"""
