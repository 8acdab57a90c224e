"""GPUs, through WebGPU: the same kernels as on the CPU, as WGSL, on whatever adapter there is.

``adapter`` finds and opens one, ``stream`` collects work and hands it over, ``memory`` holds buffers, ``program`` makes
pipelines of shaders and ``device`` puts them behind the ``Device`` contract. wgpu is imported here and in the window,
nowhere else, and not before a GPU is asked for. This file imports nothing: looking whether there may be a GPU at all
(``adapter``) must cost a process without one nothing.
"""
