"""The live window: ``zeroset view`` and ``zs.show``, on the desktop and in a notebook.

In reading order: `state` (what the user has chosen, pure data), `formula` (text to surface), `orbit` and `controls`
(camera and mouse), `pace` (resolution while moving), `worker` and `painting` (threads that compile and draw),
`overlay` and `lines` (what is drawn over the picture), `panels/` (one section of the sidebar each), `picture` (the
pixels on the screen), `window` (all of it in one loop), `show` (the way in). Nothing of it is loaded by
``import zeroset``, and what draws windows (wgpu, rendercanvas, glfw, Dear ImGui) only when there is a window to draw.
"""
