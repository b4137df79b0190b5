"""Teach Numba what an operator or function does on lanes: one call says type rule and code."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import lower_builtin

from graphfx.lanes.types import Real, Vec3Type, convert, joined

Generator = Callable[..., Any]


def define(function: Any, count: int, generate: Generator, result: Callable[[Real], types.Type] = lambda real: real) -> None:
    """Define `function` of `count` reals or numbers: `generate(builder, real, *values)` gives LLVM code."""

    @infer_global(function)
    class _Rule(AbstractTemplate):
        def generic(self, args: Any, kws: Any) -> Any:
            real = joined(args) if len(args) == count else None
            if real is None:
                return None
            return signature(result(real), *(a if isinstance(a, Real) else real for a in args))

    def lower(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        real = joined(sig.args)
        assert real is not None
        return generate(builder, real, *(convert(context, builder, v, t, real) for v, t in zip(values, sig.args, strict=True)))

    lower_builtin(function, *[Real] * count)(lower)


def _element(type_: types.Type) -> types.Type:
    return type_.element if isinstance(type_, Vec3Type) else type_


def define_vector(function: Any, kinds: tuple[Any, ...], generate: Generator, result: Callable[[Real], types.Type]) -> None:
    """Define `function` where some arguments are `Vec3Type`: those reach `generate` as lists of three values."""
    numeric = [i for i, kind in enumerate(kinds) if kind in (Vec3Type, Real, types.Number)]

    @infer_global(function)
    class _Rule(AbstractTemplate):
        def generic(self, args: Any, kws: Any) -> Any:
            if len(args) != len(kinds) or not all(isinstance(a, k) for a, k in zip(args, kinds, strict=True)):
                return None
            real = joined([_element(args[i]) for i in numeric])
            return None if real is None else signature(result(real), *args)

    def lower(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        real = joined([_element(sig.args[i]) for i in numeric])
        assert real is not None
        parts: list[Any] = []
        for i, (value, type_) in enumerate(zip(values, sig.args, strict=True)):
            if isinstance(type_, Vec3Type):
                proxy = cgutils.create_struct_proxy(type_)(context, builder, value=value)
                parts.append([convert(context, builder, getattr(proxy, name), type_.element, real) for name in "xyz"])
            else:
                parts.append(convert(context, builder, value, type_, real) if i in numeric else value)
        made = generate(builder, *parts)
        if not isinstance(sig.return_type, Vec3Type):
            return made
        proxy = cgutils.create_struct_proxy(sig.return_type)(context, builder)
        proxy.x, proxy.y, proxy.z = made
        return proxy._getvalue()

    lower_builtin(function, *kinds)(lower)
