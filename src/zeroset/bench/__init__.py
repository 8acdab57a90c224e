"""How fast zeroset is on this machine: what ``zeroset bench`` measures, without saying how it is shown.

``timing`` holds the clock, ``meter`` a device that counts compilations, ``limit`` the kernel that frames are held
against; ``frames``, ``gpu``, ``memory`` and ``cold`` are the measurements, and ``machine`` says where figures were
made. ``printed`` has what papers have printed: ``papers`` takes the best of it, ``rerun`` measures their tables once
more. None of them decides a test.
"""
