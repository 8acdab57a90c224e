"""Running kernels: one contract (``device``), and the machines that keep it.

``cpu`` compiles to SIMD code and runs it on all cores (``pool``), ``gpu`` compiles to WGSL and runs it on whatever
adapter WebGPU finds, ``interp`` is the target of last resort. ``cache`` keeps compiled code across processes, and a
``twin`` compiles beside this one. ``get_device`` finds a device by name, and loads no other.
"""

from zeroset.runtime.device import Counted, Device, Program, Recipe, Signature
from zeroset.runtime.registry import DEVICES, get_device

__all__ = ["DEVICES", "Counted", "Device", "Program", "Recipe", "Signature", "get_device"]
