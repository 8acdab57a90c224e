"""How fast zeroset is on this machine: what ``zeroset bench`` measures, without saying how it is shown.

``timing`` holds the clock, ``meter`` a device that counts compilations, ``limit`` the kernel that frames are held
against; ``frames``, ``memory`` and ``cold`` are the three measurements and ``machine`` says where they were made. No
figure here decides a test.
"""
