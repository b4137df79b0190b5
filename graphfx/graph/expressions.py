"""Expressions: `{"expr": "1 - age / life"}` to a checked tree of calls, by recursive descent.

    expression = either ["if" either "else" expression]
    either     = both {"or" both}                both = negation {"and" negation}
    negation   = "not" negation | comparison     comparison = sum {("<" | "<=" | ...) sum}
    sum        = product {("+" | "-") product}   product = sign {("*" | "/" | "%") sign}
    sign       = ("-" | "+") sign | power        power = postfix ["**" sign]
    postfix    = atom {"." ("x" | "y" | "z")}    atom = number | name | call | "(" expression ")"

`a < b < c` means `a < b and b < c`. Nothing of Python is evaluated: the tree holds only calls of
`FUNCTIONS`, names, values and numbers.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NoReturn

from graphfx.errors import suggestion
from graphfx.graph.functions import ANY_NUMBER, BINARY, CALLED, CONSTANTS, FUNCTIONS, in_words
from graphfx.graph.items import shown
from graphfx.graph.lexer import FOREIGN, KEYWORDS, QUALIFIERS, TOKEN
from graphfx.graph.limits import Limits
from graphfx.graph.values import Call, measure

_COMPARISONS = ("<", "<=", ">", ">=", "==", "!=")
_MOST_BRACKETS = 30
"""Each bracket is a dozen calls of the parser, and Python allows about a thousand."""


@dataclass(frozen=True)
class Mistake:
    """Something wrong in an expression; columns count from 0."""

    message: str
    column: int
    notes: tuple[str, ...] = ()


class _Stop(Exception):
    """The text cannot be read further."""


Resolve = Callable[[str], "tuple[Any, str] | str"]
"""Finds what a name means: its tree and type, or the message that says why it means nothing."""
Members = Callable[[str], "dict[str, tuple[Any, str]]"]
"""Finds the results of a named value that has several, by name."""


def parse(text: str, resolve: Resolve, limits: Limits | None = None,
          members: Members = lambda name: {}) -> tuple[Any, str, list[Mistake]]:
    """Return an expression's tree, its type ('float', 'vec3', 'bool', or '' where mistakes hide it), and all mistakes."""
    parser = _Parser(text, resolve, members, limits or Limits())
    try:
        tree, kind = parser.whole()
    except _Stop:
        tree, kind = None, ""
    return tree, kind, parser.mistakes


class _Parser:
    def __init__(self, text: str, resolve: Resolve, members: Members, limits: Limits):
        self.text, self.resolve, self.members, self.limits = text, resolve, members, limits
        self.mistakes: list[Mistake] = []
        self.depth = 0
        self.tokens: list[tuple[str, str, int]] = []
        self.next = 0

    def note(self, message: str, column: int, *notes: str) -> None:
        self.mistakes.append(Mistake(message, column, notes))

    def stop(self, message: str, column: int) -> NoReturn:
        self.note(message, column)
        raise _Stop

    def whole(self) -> tuple[Any, str]:
        if len(self.text) > self.limits.expression:
            self.stop(f"the expression has {len(self.text)} characters, more than the limit of {self.limits.expression}; "
                      "give parts of it names under \"values\", or raise the limit on expressions", 0)
        self.scan()
        result = self.expression()
        kind, word, column = self.peek()
        if kind:
            meant = FOREIGN.get(word, "an operator or the end of the expression should")
            self.stop(f"'{word}' cannot stand here; {meant}", column)
        return result

    def scan(self) -> None:
        at = 0
        while self.text[at:].strip():
            token = TOKEN.match(self.text, at)
            if token is None:
                while self.text[at].isspace():
                    at += 1
                self.stop(f"{shown(self.text[at])} has no meaning in an expression", at)
            kind = token.lastgroup or ""
            self.tokens.append((kind, token.group(kind), token.start(kind)))
            at = token.end()
        if not self.tokens:
            self.stop("the expression is empty", 0)

    def peek(self) -> tuple[str, str, int]:
        return self.tokens[self.next] if self.next < len(self.tokens) else ("", "", len(self.text))

    def take(self, *words: str) -> tuple[str, int] | None:
        kind, word, column = self.peek()
        if kind in ("sign", "name") and word in words:
            self.next += 1
            return word, column
        return None

    def call(self, name: str, arguments: tuple[tuple[Any, str], ...], column: int, spelled: str = "") -> tuple[Any, str]:
        """Return a checked call; a mistake is told at `column` and leaves the type unknown."""
        function = FUNCTIONS[name]
        kinds = tuple(kind for _, kind in arguments)
        result = function.result(kinds)
        if result is None:
            takes = ", or ".join(in_words(types) for types, _ in function.forms)
            self.note(f"{spelled or name} takes {takes}; here it is given {in_words(kinds)}", column)
        elif "" in kinds and len({outcome for _, outcome in function.forms}) > 1:
            result = ""
        call = Call(name, tuple(tree for tree, _ in arguments))
        if measure(call).depth > self.limits.expression_depth:
            self.stop(f"the expression nests deeper than the limit of {self.limits.expression_depth}; "
                      "compute it with fewer terms, or raise the limit on expression_depth", column)
        return call, result or ""

    def expression(self) -> tuple[Any, str]:
        self.depth += 1
        if self.depth > _MOST_BRACKETS:
            self.stop(f"more than {_MOST_BRACKETS} brackets stand inside one another; "
                      "give parts of the expression names under \"values\"", self.peek()[2])
        result = self.either()
        found = self.take("if")
        if found:
            condition = self.either()
            if not self.take("else"):
                self.stop("a choice is written 'a if condition else b'; 'else' is missing", self.peek()[2])
            result = self.call("select", (condition, result, self.expression()), found[1], "'a if condition else b'")
        self.depth -= 1
        return result

    def chain(self, operand: Callable[[], tuple[Any, str]], words: dict[str, str]) -> tuple[Any, str]:
        result = operand()
        while found := self.take(*words):
            result = self.call(words[found[0]], (result, operand()), found[1], f"'{found[0]}'")
        return result

    def either(self) -> tuple[Any, str]:
        return self.chain(self.both, {"or": "or"})

    def both(self) -> tuple[Any, str]:
        return self.chain(self.negation, {"and": "and"})

    def negation(self) -> tuple[Any, str]:
        count, column = 0, 0
        while found := self.take("not"):
            count, column = count + 1, found[1]
        result = self.comparison()
        return self.call("not", (result,), column, "'not'") if count % 2 else result

    def comparison(self) -> tuple[Any, str]:
        left = self.sum()
        result = None
        while found := self.take(*_COMPARISONS):
            right = self.sum()
            one = self.call(BINARY[found[0]], (left, right), found[1], f"'{found[0]}'")
            result = one if result is None else self.call("and", (result, one), found[1])
            left = right
        return left if result is None else result

    def sum(self) -> tuple[Any, str]:
        return self.chain(self.product, {word: BINARY[word] for word in "+-"})

    def product(self) -> tuple[Any, str]:
        return self.chain(self.sign, {word: BINARY[word] for word in "*/%"})

    def sign(self) -> tuple[Any, str]:
        negative, column = False, 0
        while found := self.take("-", "+"):
            negative, column = negative != (found[0] == "-"), found[1]
        result = self.power()
        if not negative:
            return result
        return (-result[0], "float") if type(result[0]) is float else self.call("negate", (result,), column, "'-'")

    def power(self) -> tuple[Any, str]:
        base = self.postfix()
        found = self.take("**")
        if not found:
            return base
        self.depth += 1
        if self.depth > _MOST_BRACKETS:
            self.stop(f"more than {_MOST_BRACKETS} powers of powers stand here; write the product of the exponents", found[1])
        result = self.call("power", (base, self.sign()), found[1], "'**'")
        self.depth -= 1
        return result

    def postfix(self) -> tuple[Any, str]:
        result = self.atom()
        while self.take("."):
            _, word, column = self.peek()
            if word not in ("x", "y", "z"):
                self.stop(f"after the dot should stand x, y or z, not {shown(word) if word else 'the end'}", column)
            self.next += 1
            result = self.call(f"component_{word}", (result,), column, f"'.{word}'")
        return result

    def atom(self) -> tuple[Any, str]:
        kind, word, column = self.peek()
        if kind == "number":
            self.next += 1
            return self.number(word, column), "float"
        if kind == "name" and word not in KEYWORDS:
            self.next += 1
            return self.called(word, column) if self.take("(") else self.named(word, column)
        if self.take("("):
            result = self.expression()
            if not self.take(")"):
                self.stop("the bracket that opens here is not closed; write ')'", column)
            return result
        if not kind:
            self.stop("the expression ends where a number, a name or '(' should stand", column)
        meant = FOREIGN.get(word)
        self.stop(f"a number, a name or '(' should stand here, not '{word}'" + (f"; {meant}" if meant else ""), column)

    def number(self, word: str, column: int) -> float:
        value = float(word)
        if value == float("inf"):
            self.note(f"the number {word} is too large; write 'infinity' if that is meant", column)
        return value

    def named(self, word: str, column: int) -> tuple[Any, str]:
        if word in QUALIFIERS:
            parts = [word]
            while self.take("."):
                kind, part, at = self.peek()
                if kind != "name":
                    self.stop(f"after '{'.'.join(parts)}.' a name should stand", at)
                parts.append(part)
                self.next += 1
                if len(parts) > 1 and not (len(parts) == 2 and self.after_dot() in ("start", "end")):
                    break
            word = ".".join(parts)
        following = self.after_dot()
        members = self.members(word) if following and following not in ("x", "y", "z") else {}
        if members:
            self.next += 2
            if following in members:
                return members[following]
            near = suggestion(following, members)
            self.note(f"'{word}' has no result '{following}'." + near, column, f"its results: {', '.join(members)}")
            return None, ""
        value = CONSTANTS.get(word)
        found = self.resolve(word) if value is None else (value, "bool" if isinstance(value, bool) else "float")
        if isinstance(found, str):
            self.note(found, column)
            return None, ""
        return found

    def after_dot(self) -> str:
        following = self.tokens[self.next : self.next + 2]
        return following[1][1] if len(following) == 2 and following[0][1] == "." else ""

    def called(self, word: str, column: int) -> tuple[Any, str]:
        arguments: list[tuple[Any, str]] = []
        if not self.take(")"):
            while True:
                arguments.append(self.expression())
                if self.take(")"):
                    break
                if not self.take(","):
                    self.stop(f"in the arguments of {word}(...) ',' or ')' should stand here", self.peek()[2])
        name = CALLED.get(word)
        if name is None:
            self.note(f"there is no function '{word}'." + suggestion(word, CALLED), column, f"functions: {', '.join(CALLED)}")
            return None, ""
        function = FUNCTIONS[name]
        if word in ANY_NUMBER and len(arguments) > 2:
            result = arguments[0]
            for argument in arguments[1:]:
                result = self.call(name, (result, argument), column, word)
            return result
        if len(arguments) != function.argument_count:
            spelling = "pow(a, b)" if word == "pow" else function.spelling
            count = f"{len(arguments)} argument{'s' * (len(arguments) != 1)}"
            self.note(f"{word} is called as {spelling}, but has {count} here", column)
            return None, ""
        return self.call(name, tuple(arguments), column, word)
