"""Have Numba use the whole vector registers of this machine.

Numba takes some AVX-512 processors for older ones, and LLVM keeps to 256 bits on others; with the
processor's own name and features, less `prefer-256-bit`, kernels are 1.4 to 1.9 times as fast, and
give the same bits.
"""

from __future__ import annotations

import os
from collections.abc import MutableMapping

SWITCH = "GRAPHFX_WIDE_REGISTERS"
"""Set to 0, this environment variable leaves the choice to Numba."""
NAME, FEATURES = "NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES"


def use_wide_registers(environment: MutableMapping[str, str] | None = None) -> bool:
    """Ask Numba for 512-bit registers where there are any; return whether it was asked.

    Call it before the first kernel is loaded: `graphfx` does, `import graphfx` never. What the user
    has set is left alone.
    """
    environment = os.environ if environment is None else environment
    if environment.get(SWITCH) == "0" or NAME in environment or FEATURES in environment:
        return False
    import llvmlite.binding

    features = llvmlite.binding.get_host_cpu_features()
    if not features.get("avx512f"):
        return False
    environment[NAME] = llvmlite.binding.get_host_cpu_name()
    environment[FEATURES] = f"{features.flatten()},-prefer-256-bit"
    from numba.core import config

    config.reload_config()
    return True
