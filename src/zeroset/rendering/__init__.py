"""A frame: kernels over named buffers, run in order on one device, and the picture that comes out."""
