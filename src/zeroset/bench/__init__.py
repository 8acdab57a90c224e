"""How fast zeroset is on this machine: what ``zeroset bench`` measures, without saying how it is shown.

``timing`` holds the clock, ``meter`` a device that counts compilations, ``limit`` the kernel that frames are held
against; ``frames``, ``gpu``, ``memory`` and ``cold`` are the measurements, ``papers`` has what others have printed, and
``machine`` says where figures were made. None of them decides a test.
"""
