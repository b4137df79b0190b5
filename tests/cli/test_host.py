"""Whole vector registers, asked for by the command and not by the import."""

from __future__ import annotations

import subprocess
import sys

import llvmlite.binding
import pytest

from graphfx.lanes.host import FEATURES, NAME, SWITCH, use_wide_registers

WIDE = bool(llvmlite.binding.get_host_cpu_features().get("avx512f"))


@pytest.mark.parametrize("own", [{SWITCH: "0"}, {NAME: "generic"}, {FEATURES: ""}])
def test_user_has_the_last_word(own: dict[str, str]) -> None:
    """Whoever switches it off, or sets Numba's own variables, is left alone."""
    environment = dict(own)
    assert not use_wide_registers(environment)
    assert environment == own


@pytest.mark.skipif(not WIDE, reason="this processor has no 512-bit registers")
def test_asked_for_in_full() -> None:
    """Numba is told the processor's own name and not to prefer 256 bits."""
    environment: dict[str, str] = {}
    assert use_wide_registers(environment)
    assert environment[NAME] == llvmlite.binding.get_host_cpu_name()
    assert environment[FEATURES].endswith(",-prefer-256-bit")


@pytest.mark.skipif(not WIDE, reason="this processor has no 512-bit registers")
@pytest.mark.parametrize(("call", "wide"), [("use_wide_registers()", True), ("None", False)])
def test_code_is_made_for_them(call: str, wide: bool) -> None:
    """What Numba compiles is for 512 bits after the call, though numba was imported before, and only then."""
    code = ("import graphfx, numba\nfrom graphfx.lanes.host import use_wide_registers\n" + call +
            "\nimport graphfx.store\nfrom numba.core.registry import cpu_target\n"
            "print('-prefer-256-bit' in str(cpu_target.target_context.codegen().magic_tuple()))")
    environment = {"PATH": "", "PYTHONPATH": ":".join(sys.path)}
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, env=environment)
    assert result.stdout == f"{wide}\n"
