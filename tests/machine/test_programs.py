"""Programs on the block machine leave the bits that plain Python leaves, however they are run."""

from __future__ import annotations

import numpy as np
import pytest

from .programs import RandomProgram, Setting, arrays_for, copied, differences, in_plain_python, on_machine, same_both_ways


@pytest.mark.parametrize("precision", [32, 64])
@pytest.mark.parametrize("seed", range(12))
def test_random_programs(seed, precision):
    """Calls, draws, masks and loops written at random mean the same on blocks, the last one partial, as one by one."""
    made = RandomProgram(seed)
    same_both_ways(made.program, Setting(300, precision, uniforms=made.uniforms), seed)


@pytest.mark.parametrize("seed", [20, 21])
def test_listed_rows(seed):
    """Rows given by a list, in any order, get what they get in order, and no other row is touched."""
    made = RandomProgram(seed)
    listed = np.random.default_rng(seed).permutation(1000)[:270]
    arrays = arrays_for(made.program, 1000, 32)
    whole, part = copied(arrays), copied(arrays)
    on_machine(made.program, whole, Setting(1000, 32, uniforms=made.uniforms))
    on_machine(made.program, part, Setting(1000, 32, listed, uniforms=made.uniforms))
    wanted = copied(arrays)
    for name in wanted:
        for target, source in zip(wanted[name], whole[name], strict=True):
            target[listed] = source[listed]
    assert differences(part, wanted, 1000) == []


@pytest.mark.parametrize("listed", [None, np.array([5, 299, 0, 17, 256, 255])])
def test_excluded_rows(listed):
    """Rows that are left out keep what they hold, in both ways of running."""
    made = RandomProgram(30)
    excluded = np.array([0, 1, 17, 255, 299]) if listed is None else None
    same_both_ways(made.program, Setting(300, 32, listed, excluded, made.uniforms))


@pytest.mark.parametrize("threads", [2, 3, 7])
@pytest.mark.parametrize("seed", [40, 41])
def test_threads(seed, threads):
    """Any number of threads leaves the same bits; there are more pieces than threads."""
    made = RandomProgram(seed)
    count = 256 * 16 * 5 + 77
    arrays = arrays_for(made.program, count, 32)
    alone, together = copied(arrays), copied(arrays)
    on_machine(made.program, alone, Setting(count, 32, uniforms=made.uniforms))
    on_machine(made.program, together, Setting(count, 32, uniforms=made.uniforms, threads=threads))
    assert all(one.tobytes() == other.tobytes() for name in alone for one, other in zip(alone[name], together[name], strict=True))


def test_particle_alone():
    """One particle in a block of its own gets what it gets among 700."""
    made = RandomProgram(50)
    arrays = arrays_for(made.program, 700, 32)
    whole = copied(arrays)
    on_machine(made.program, whole, Setting(700, 32, uniforms=made.uniforms))
    for row in (0, 255, 256, 699):
        alone = copied(arrays)
        on_machine(made.program, alone, Setting(700, 32, np.array([row]), uniforms=made.uniforms))
        assert (
            differences(
                {name: tuple(part[row : row + 1] for part in parts) for name, parts in alone.items()},
                {name: tuple(part[row : row + 1] for part in parts) for name, parts in whole.items()},
                1,
            )
            == []
        )


@pytest.mark.parametrize("listed", [None, np.arange(290, 5, -3)])
def test_rejected_rows(listed):
    """Rejected rows are returned in the order in which they ran, and keep what they hold."""
    made = RandomProgram(60)
    made.program.rejects = made.program.loads["flag"]
    setting = Setting(300, 32, listed, uniforms=made.uniforms)
    rejected = in_plain_python(made.program, arrays_for(made.program, 300, 32, 1), setting)
    assert 0 < len(rejected) < (300 if listed is None else len(listed))
    same_both_ways(made.program, setting, 1)


def test_columns_by_place():
    """A column that runs along with the list is read and written at the place in the list, not at the row."""
    made = RandomProgram(70)
    stored = tuple(name for name in made.program.stores if name.startswith("out"))[:2]
    setting = Setting(300, 32, np.arange(299, 29, -1), uniforms=made.uniforms, by_place=("a", "p", "id", "flag", *stored))
    same_both_ways(made.program, setting)


def test_nothing_to_run():
    """No rows, an empty list and all rows excluded change nothing."""
    made = RandomProgram(80)
    arrays = arrays_for(made.program, 300, 32)
    for setting in (Setting(0, 32), Setting(300, 32, np.zeros(0, np.int64)), Setting(300, 32, None, np.arange(300))):
        setting.uniforms = made.uniforms
        after = copied(arrays)
        assert not len(on_machine(made.program, after, setting))
        assert differences(after, arrays, 300) == []
