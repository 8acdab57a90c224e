"""The picture on the screen: one texture, stretched over its pane."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

SHADER = """
struct Corner { @builtin(position) position: vec4<f32>, @location(0) place: vec2<f32> };

@vertex fn corner(@builtin(vertex_index) index: u32) -> Corner {
    // One triangle that covers the viewport.
    let place = vec2<f32>(f32((index << 1u) & 2u), f32(index & 2u));
    return Corner(vec4<f32>(place.x * 2.0 - 1.0, 1.0 - place.y * 2.0, 0.0, 1.0), place);
}

@group(0) @binding(0) var smooth_sampler: sampler;
@group(0) @binding(1) var picture: texture_2d<f32>;

@fragment fn color(corner: Corner) -> @location(0) vec4<f32> {
    return vec4<f32>(textureSample(picture, smooth_sampler, corner.place).rgb, 1.0);
}
"""


class PictureView:
    """Shows bytes of RGBA in a part of the window.

    Args:
        device: a wgpu device.
        target: the format of what is drawn on.
    """

    def __init__(self, device: Any, target: str) -> None:
        self._device = device
        module = device.create_shader_module(code=SHADER)
        self._pipeline = device.create_render_pipeline(
            layout="auto",
            vertex={"module": module, "entry_point": "corner"},
            primitive={"topology": "triangle-list"},
            fragment={"module": module, "entry_point": "color", "targets": [{"format": target}]},
        )
        self._sampler = device.create_sampler(mag_filter="linear", min_filter="linear")
        self._texture: Any = None
        self._group: Any = None

    def upload(self, pixels: npt.NDArray[np.uint8]) -> None:
        """Show these pixels, (height, width, 4), from now on."""
        height, width = pixels.shape[:2]
        if self._texture is None or self._texture.size[:2] != (width, height):
            self._allocate(width, height)
        layout = {"bytes_per_row": 4 * width, "rows_per_image": height}
        self._device.queue.write_texture({"texture": self._texture}, pixels, layout, (width, height, 1))

    def _allocate(self, width: int, height: int) -> None:
        import wgpu

        usage = wgpu.TextureUsage.TEXTURE_BINDING | wgpu.TextureUsage.COPY_DST
        self._texture = self._device.create_texture(size=(width, height, 1), format="rgba8unorm", usage=usage)
        entries = [
            {"binding": 0, "resource": self._sampler},
            {"binding": 1, "resource": self._texture.create_view()},
        ]
        self._group = self._device.create_bind_group(layout=self._pipeline.get_bind_group_layout(0), entries=entries)

    def draw(self, target: Any, place: tuple[float, float, float, float], behind: tuple[float, float, float]) -> None:
        """Draw into a texture view.

        Args:
            target: the view.
            place: x, y, width and height in pixels of the target.
            behind: sRGB colour around the picture.
        """
        encoder = self._device.create_command_encoder()
        attachment = {"view": target, "load_op": "clear", "store_op": "store", "clear_value": (*behind, 1.0)}
        draw = encoder.begin_render_pass(color_attachments=[attachment])
        if self._group is not None and place[2] >= 1 and place[3] >= 1:
            draw.set_viewport(*place, 0.0, 1.0)
            draw.set_pipeline(self._pipeline)
            draw.set_bind_group(0, self._group)
            draw.draw(3)
        draw.end()
        self._device.queue.submit([encoder.finish()])
