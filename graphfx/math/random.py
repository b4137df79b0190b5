"""Random numbers from a counter: no state, so they depend on what is asked and on nothing else.

    words = philox4x32((id low, id high, life, cell), key_of(graph seed, path, ...))

A draw is a function of who asks (particle, number of its life), when (time cell) and for what (key), so
that it does not depend on threads, order, other particles or the number of steps. [Salmon, Moraes, Dror
and Shaw 2011, Parallel random numbers: as easy as 1, 2, 3: Philox4x32-10, which passes TestU01's BigCrush]

The words of a counter are Python integers, or NumPy arrays of them for many draws at once.
"""

from __future__ import annotations

import hashlib
from typing import Any

import numpy as np

__all__ = ["counter_of", "key_of", "philox4x32", "spawned_id", "uniform"]

WORD = 0xFFFFFFFF
ROUNDS = 10
PHILOX_MULTIPLIERS = (0xD2511F53, 0xCD9E8D57)
PHILOX_WEYL = (0x9E3779B9, 0xBB67AE85)  # the fractions of the golden ratio and of sqrt(3), times 2**32
SPAWN_TAG = 0x6E777073  # "spwn": the fourth word of the counter that makes an id
SPAWNED = 1 << 63  # set in the id of every spawned particle, never in an ordinal of birth


def philox4x32(counter: tuple[Any, Any, Any, Any], key: tuple[Any, Any]) -> tuple[Any, Any, Any, Any]:
    """Four random words of 32 bits from a counter of four such words and a key of two.

    Each round multiplies two words into 64 bits and mixes the halves with the rest and the key:

        a, b, c, d  <-  high(M1 c) ^ b ^ k0,  low(M1 c),  high(M0 a) ^ d ^ k1,  low(M0 a)

    and the key grows by the Weyl constants, wrapping. For one key, different counters never give the same
    four words. Python integers give Python integers; arrays give arrays of uint64.
    """
    a, b, c, d = (word_of(word) for word in counter)
    first, second = (word_of(word) for word in key)
    for _ in range(ROUNDS):
        product0, product1 = a * PHILOX_MULTIPLIERS[0], c * PHILOX_MULTIPLIERS[1]
        a, b, c, d = (product1 >> 32) ^ b ^ first, product1 & WORD, (product0 >> 32) ^ d ^ second, product0 & WORD
        first, second = (first + PHILOX_WEYL[0]) & WORD, (second + PHILOX_WEYL[1]) & WORD
    return a, b, c, d


def word_of(value: Any) -> Any:
    """An integer modulo 2**32, or an array of them as uint64, in which products of words are exact."""
    if isinstance(value, np.ndarray):
        return value.astype(np.uint64) & np.uint64(WORD)
    return int(value) & WORD


def uniform(bits: Any, kind: Any = np.float64) -> Any:
    """A number in [0, 1) from a word: float32 (bits >> 8) * 2**-24, float64 bits * 2**-32.

    Both are exact, and the first is the second cut to 24 bits: they differ by less than 2**-24.
    """
    if np.dtype(kind) == np.float32:
        return np.asarray(bits >> 8).astype(np.float32)[()] * np.float32(2.0**-24)
    return np.asarray(bits).astype(np.float64)[()] * 2.0**-32


def key_of(*parts: int | str) -> tuple[int, int]:
    """The key of a stream of random numbers: two words hashed from integers and strings by BLAKE2b.

    The encoding is unambiguous: each part is its kind ("i" or "s"), its number of bytes (8 bytes, little
    endian) and its bytes, an integer in two's complement of least length, a string in UTF-8. So 1, "1",
    ("ab", "c") and ("a", "bc") all differ.
    """
    digest = hashlib.blake2b(digest_size=8, person=b"graphfx.random")
    for part in parts:
        digest.update(encoded(part))
    hashed = int.from_bytes(digest.digest(), "little")
    return hashed & WORD, hashed >> 32


def encoded(part: int | str) -> bytes:
    """One part of a key as bytes that end where they say."""
    if isinstance(part, str):
        kind, content = b"s", part.encode()
    elif isinstance(part, (int, np.integer)) and not isinstance(part, bool):
        number = int(part)
        kind, content = b"i", number.to_bytes((number.bit_length() + 8) // 8, "little", signed=True)
    else:
        raise TypeError(f"key_of takes integers and strings, not {part!r} of type {type(part).__name__}")
    return kind + len(content).to_bytes(8, "little") + content


def spawned_id(parent: Any, life: Any, event: Any, number: Any) -> Any:
    """The id, of 64 bits, of copy `number` among the particles spawned by an event of a parent.

    A particle that its emitter bore has its ordinal of birth for id. This is a hash: Philox with the
    counter (parent low, parent high, life, a tag) and the key (event, number), with the highest bit set, so
    that it is no ordinal; among a million spawned particles the chance that two share an id is 5e-8.
    life, event and number count modulo 2**32. Arrays of uint64 give arrays.
    """
    low, high, _, _ = philox4x32(counter_of(parent, life, SPAWN_TAG), (event, number))
    return low | high << 32 | SPAWNED


def counter_of(particle_id: Any, life: Any = 0, cell: Any = 0) -> tuple[Any, Any, Any, Any]:
    """The counter of a draw: (id low, id high, number of the life, time cell), of 32 bits each."""
    return particle_id & WORD, particle_id >> 32, life, cell
