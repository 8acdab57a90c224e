"""Shaders made without wgpu's own run-time checks, where that can be had.

wgpu adds to every shader what a web page's needs: each access clamped to its buffer, each loop counted so that it ends.
Our kernels are verified and run without such checks on the CPU too, and their loops end. On software Vulkan the
checks nearly double the time that a driver takes over a shader. The function that leaves them out is one of
wgpu-native's own, which wgpu-py has no method for; where it is missing the shader is made the usual way.
"""

from __future__ import annotations

from typing import Any

_NO_CHECKS = 0


def shader_module(device: Any, code: str, label: str) -> Any:
    """wgpu's shader module of WGSL; errors are wgpu's."""
    try:
        from wgpu.backends.wgpu_native import _api as native

        ffi, create = native.ffi, native.libf.wgpuDeviceCreateShaderModuleTrusted
        kind = native.lib.WGPUSType_ShaderSourceWGSL
        made = native.GPUShaderModule
    except (ImportError, AttributeError):
        return device.create_shader_module(code=code, label=label)
    text, name = ffi.new("char[]", code.encode()), ffi.new("char[]", label.encode())
    source = ffi.new("WGPUShaderSourceWGSL *")
    source.chain.sType = kind
    source.code.data, source.code.length = text, len(text) - 1
    descriptor = ffi.new("WGPUShaderModuleDescriptor *")
    descriptor.nextInChain = ffi.cast("WGPUChainedStruct *", source)
    descriptor.label.data, descriptor.label.length = name, len(name) - 1
    module = create(device._internal, descriptor, _NO_CHECKS)
    if module == ffi.NULL:
        return device.create_shader_module(code=code, label=label)
    return made(label, module, device)
