"""The instruction loop: broadcast a program over blocks of particles.

For each block: copy the live columns into the scratch, run every instruction on it, copy back what
changed. The scratch of a block stays in the first-level cache. The loop calls kernels by address,
so it is compiled once for all programs.

Code is a flat int64 array. A call is (CALL, length, address, operands...), a loop
(LOOP, length of the whole, first lane of its mask, limit, body...); offsets count elements.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from graphfx.lanes import compiled
from graphfx.lanes.inner import inner
from graphfx.machine.transfer import BLOCK, load_block, store_block

CALL, LOOP = 0, 1
MASK_WORDS = BLOCK // 16
DEPTH = 8
"""Loops inside loops, at most."""


@intrinsic
def _call_kernel(typing: Any, address: Any, scratch: Any, code: Any, place: Any, masks: Any) -> Any:
    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        data = [context.make_array(sig.args[i])(context, builder, values[i]).data for i in (1, 2, 4)]
        data[1] = builder.gep(data[1], [values[3]])
        kind = ir.FunctionType(ir.VoidType(), [d.type for d in data])
        builder.call(builder.inttoptr(values[0], kind.as_pointer()), data)
        return context.get_dummy_value()

    return types.void(types.int64, scratch, code, types.int64, masks), generate


@inner
def _any(masks, first):
    for word in range(first >> 4, (first >> 4) + MASK_WORDS):
        if masks[word] != 0:
            return True
    return False


@inner
def _execute(code, scratch, masks, stack):
    """Run the code once; `stack` has room for where each open loop begins, and DEPTH further on for its turns."""
    depth = 0
    place = 0
    while True:
        while depth > 0 and place == stack[depth - 1] + code[stack[depth - 1] + 1]:
            begin = stack[depth - 1]
            stack[DEPTH + depth - 1] += 1
            if stack[DEPTH + depth - 1] < code[begin + 3] and _any(masks, code[begin + 2]):
                place = begin + 4
            else:
                depth -= 1
        if place >= code.size:
            break
        if code[place] == CALL:
            _call_kernel(code[place + 2], scratch, code, place + 3, masks)
            place += code[place + 1]
        elif _any(masks, code[place + 2]):
            stack[depth] = place
            stack[DEPTH + depth] = 0
            depth += 1
            place += 4
        else:
            place += code[place + 1]


@inner
def _set_context(masks, excluded, rows, first, count):
    """Put the lanes that run into the first mask: those of the rows there are, less the excluded."""
    for word in range(MASK_WORDS):
        lanes = min(max(count - word * 16, 0), 16)
        masks[word] = np.uint16((1 << lanes) - 1)
        if rows.size == 0 and excluded.size > 0:
            masks[word] &= ~excluded[(first >> 4) + word]


@compiled
def run_blocks(code, loads, stores, scratch, words, masks, stack, rows, excluded, rejected, rejects, counts, now):
    """Run a program on blocks counts[0] to counts[1] of counts[2] rows.

    `stack` is room for 2 DEPTH numbers. `rows` lists the rows, or is empty for all in order. `excluded` has a
    bit for each row that does not run; `rejected` takes a bit for each row whose lane is on in the mask that
    begins at `rejects` (-1: none).
    """
    for block in range(counts[0], counts[1]):
        first = block * BLOCK
        count = min(BLOCK, counts[2] - first)
        _set_context(masks, excluded, rows, first, count)
        if not _any(masks, 0):
            continue
        load_block(loads, scratch, words, masks, rows, first, count, now)
        _execute(code, scratch, masks, stack)
        if rejects >= 0:
            for word in range(MASK_WORDS):
                out = masks[(rejects >> 4) + word] & masks[word]
                rejected[(first >> 4) + word] = out
                masks[word] &= ~out
        store_block(stores, scratch, masks, rows, first, 0)
