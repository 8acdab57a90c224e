"""How an animation is made, in reading order.

`path` and `camera_path` (how values and cameras run), `storyboard` (the scene of every frame), `named` (animations
that are data), `target` (what is written), `frames` (kept until all are there), `movie` and `gif` (put together).
"""
