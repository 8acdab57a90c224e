"""Running kernels: one contract (``device``), and the machines that keep it.

``cpu`` compiles to SIMD code and runs it on all cores (``pool``), ``interp`` is the target of last resort, and
``cache`` keeps compiled code across processes. ``get_device`` finds one by name, and loads no other.
"""

from zeroset.runtime.device import Device, Program, Signature
from zeroset.runtime.registry import DEVICES, get_device

__all__ = ["DEVICES", "Device", "Program", "Signature", "get_device"]
