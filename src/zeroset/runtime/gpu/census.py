"""How many objects wgpu holds: what must not grow from frame to frame."""

from __future__ import annotations


def live_objects() -> int:
    """Buffers, pipelines, bind groups and all else that wgpu holds for this process now.

    Counted by wgpu's own library, so that what Python has let go of but wgpu has not is in it.
    """
    import wgpu

    counts = wgpu.diagnostics.wgpu_native_counts.get_dict()
    return int(counts["total"]["count"])
