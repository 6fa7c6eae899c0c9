"""Cycles of a compiled shader on a GPU: a model, from its assembly and from how often each loop turns.

A *scope* is a loop, or a part that is jumped over if no lane of a wave needs it. A program's expected scopes are a
`ScopeShape`; it is an error if the compiler makes others. Times are those that ACO, the compiler of RADV, schedules
with: an instruction issues after the one before it, once its operands are ready; ``s_waitcnt`` waits for fetches.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Final

LANES: Final = 64
"""Of a wave."""

ONCE: Final = "once"
"""The scope of what every wave runs once."""


@dataclass(frozen=True, slots=True)
class Family:
    """A kind of GPU, by its compute units.

    Parameters
    ----------
    name : str
        As RADV has it.
    simds : int
        Of a compute unit.
    registers, granule, most_waves : int
        Vector registers of a SIMD, for each lane of a wave; how many are given out at once; how many waves fit.
    valu, valu_latency : int
        Cycles for which a vector instruction of a wave occupies its SIMD; until its result is there.
    complex, complex_latency : int
        The same of roots and reciprocals, and the unit for those.
    shares_unit : bool
        Whether that unit is the SIMD.
    scalar : int
        Cycles until the wave's next instruction, after a scalar one.
    fetch, fetch_latency, constant_latency : int
        Cycles for which a fetch occupies the compute unit's texture unit; until it is there, from the nearest cache;
        until a constant or descriptor is.
    """

    name: str
    simds: int
    registers: int
    granule: int
    most_waves: int
    valu: int
    valu_latency: int
    complex: int
    complex_latency: int
    shares_unit: bool
    scalar: int
    fetch: int = 16
    fetch_latency: int = 200
    constant_latency: int = 50

    def waves(self, registers: int) -> int:
        """Waves on a SIMD whose lanes take some vector registers each.

        Examples
        --------
        >>> FAMILIES["RDNA2"].waves(56), FAMILIES["GCN5"].waves(56)
        (9, 4)
        """
        taken = -(-registers // self.granule) * self.granule
        return min(self.most_waves, self.registers // taken)


FAMILIES: Final = {
    "RDNA2": Family("NAVI21", 2, 512, 8, 16, 2, 6, 8, 11, False, 1),
    "GCN5": Family("VEGA10", 4, 256, 4, 10, 4, 4, 16, 16, True, 4),
}

LEAST_SKIPPED: Final = 15
"""Instructions without a fetch that are worth a name: compilers do not agree on fewer."""

FETCH: Final = ("image_", "buffer_", "global_")
COMPLEX: Final = re.compile(r"v_(rcp|rsq|sqrt|exp|log|sin|cos|mul_lo|mul_hi)_")
REGISTER: Final = re.compile(r"\b([vs])(?:(\d+)\b|\[(\d+):(\d+)\])|\b(vcc|exec|scc)\b")
JUMP: Final = re.compile(r"s_(c?)branch\w* BB(\d+)")
SCOPE: Final = re.compile(r"(\w+)(\*?)(\??)|[()]")


@dataclass(frozen=True, slots=True)
class Cycles:
    """Cycles of a wave: of its SIMD, of the unit for roots, of the texture unit; and all of them, alone on its SIMD."""

    valu: float = 0.0
    complex: float = 0.0
    fetch: float = 0.0
    alone: float = 0.0

    def plus(self, other: "Cycles", times: float) -> "Cycles":
        """Add other cycles, `times` times."""
        return Cycles(
            self.valu + times * other.valu,
            self.complex + times * other.complex,
            self.fetch + times * other.fetch,
            self.alone + times * other.alone,
        )


@dataclass(frozen=True)
class ScopeShape:
    """The scopes of a program, as text: each with those in it, `?` for what may be jumped over, `*` if it fetches.

    Examples
    --------
    >>> shape = ScopeShape("cells*(descend(quads*?) leaf?)")
    >>> shape.parents
    {'cells': 'once', 'descend': 'cells', 'quads': 'descend', 'leaf': 'cells'}
    >>> shape.kinds
    'loop*(loop(if*) if)'
    """

    text: str

    @cached_property
    def parents(self) -> dict[str, str]:
        """The scope around each, in the order in which they begin."""
        found: dict[str, str] = {}
        around, last = [ONCE], ONCE
        for match in SCOPE.finditer(self.text):
            if match[1]:
                last = match[1]
                found[last] = around[-1]
            elif match[0] == "(":
                around.append(last)
            else:
                around.pop()
        return found

    @property
    def kinds(self) -> str:
        """The scopes without names."""
        return SCOPE.sub(lambda m: ("if" if m[3] else "loop") + m[2] if m[1] else m[0], self.text)


@dataclass
class Block:
    """Instructions without a jump among them."""

    number: int
    lines: list[str] = field(default_factory=list)

    @property
    def fetches(self) -> bool:
        """Whether a texture is read."""
        return any(line.startswith(FETCH) for line in self.lines)


@dataclass
class Scope:
    """Blocks from `first` to `last`; `checked` is the last one that runs once more than a loop turns."""

    kind: str
    first: int
    last: int
    checked: int = -1
    inner: list["Scope"] = field(default_factory=list)

    def blocks(self) -> Iterator[int]:
        """The scope's blocks, without those of scopes in it."""
        held = {k for scope in self.inner for k in range(scope.first, scope.last + 1)}
        return (k for k in range(self.first, self.last + 1) if k not in held)

    def walk(self) -> Iterator["Scope"]:
        """All scopes in it, in the order in which they begin."""
        for scope in self.inner:
            yield scope
            yield from scope.walk()


@dataclass(frozen=True, slots=True)
class ScopedProgram:
    """A compiled shader, its blocks divided into scopes."""

    blocks: Sequence[Block]
    scopes: Mapping[str, Scope]
    parents: Mapping[str, str]

    def cycles(self, turns: Mapping[str, float], family: Family) -> dict[str, Cycles]:
        """Cycles of a wave in each scope, without those in scopes within it, by how often a wave turns each."""
        counts = {**turns, ONCE: 1.0}
        found = {}
        for name, scope in self.scopes.items():
            spent = Cycles()
            for k in scope.blocks():
                entered = counts[self.parents[name]] if k <= scope.checked else 0.0
                spent = spent.plus(block_cycles(self.blocks[k], family), counts[name] + entered)
            found[name] = spent
        return found


def read_program(name: str, assembly: str, shape: ScopeShape) -> ScopedProgram:
    """Read a shader's assembly.

    Raises
    ------
    RuntimeError
        If its scopes are not those that are expected.
    """
    blocks = blocks_of(assembly)
    whole = nest_scopes(scopes_of(blocks), len(blocks))
    found = kinds_of(whole, blocks)
    if found != shape.kinds:
        raise RuntimeError(f"{name}: the compiler made {found or 'no scopes'}; expected {shape.kinds}: {shape.text}")
    scopes = {ONCE: whole, **dict(zip(shape.parents, whole.walk(), strict=True))}
    return ScopedProgram(blocks, scopes, shape.parents)


def blocks_of(assembly: str) -> list[Block]:
    """Basic blocks, in order."""
    found: list[Block] = []
    for line in assembly.splitlines():
        text = " ".join(line.partition(";")[0].split())
        if match := re.fullmatch(r"BB(\d+):", text):
            found.append(Block(int(match[1])))
        elif text and found:
            found[-1].lines.append(text)
    return found


def scopes_of(blocks: Sequence[Block]) -> list[Scope]:
    """Loops and parts that may be jumped over, not nested yet."""
    place = {block.number: k for k, block in enumerate(blocks)}
    jumps = [
        (k, place[int(match[2])], bool(match[1]))
        for k, block in enumerate(blocks)
        for line in block.lines
        if (match := JUMP.match(line))
    ]
    latches: dict[int, int] = {}
    for k, to, _ in jumps:
        if to <= k:
            latches[to] = max(k, latches.get(to, k))
    found = []
    for head, last in latches.items():
        leaves = sorted(k for k, to, _ in jumps if head <= k <= last < to)
        found.append(Scope("loop", head, last, leaves[0] if leaves else -1))
        found += [Scope("if", k + 1, last) for k in leaves[1:] if k < last]  # what a lane that broke off leaves out
    for k, to, is_conditional in jumps:
        stays = all((head <= k <= last) == (head <= to <= last) for head, last in latches.items())
        skipped = blocks[k + 1 : to]
        is_long = any(one.fetches for one in skipped) or sum(len(one.lines) for one in skipped) >= LEAST_SKIPPED
        if is_conditional and stays and is_long:
            found.append(Scope("if", k + 1, to - 1))
    return found


def nest_scopes(scopes: Sequence[Scope], count: int) -> Scope:
    """Nest scopes within each other, in one around them all."""
    whole = Scope("once", 0, count - 1)
    around = [whole]
    for scope in sorted(scopes, key=lambda one: (one.first, -one.last)):
        while scope.first > around[-1].last:
            around.pop()
        if scope.last > around[-1].last:
            raise RuntimeError(f"blocks {scope.first} to {scope.last} lie across the end of a scope")
        around[-1].inner.append(scope)
        around.append(scope)
    return whole


def kinds_of(scope: Scope, blocks: Sequence[Block]) -> str:
    """The scopes in one, as in `Shape.kinds`."""
    found = []
    for one in scope.inner:
        mark = "*" if any(blocks[k].fetches for k in one.blocks()) else ""
        inner = kinds_of(one, blocks)
        found.append(one.kind + mark + (f"({inner})" if inner else ""))
    return " ".join(found)


def registers(text: str) -> list[str]:
    """Registers that a text names.

    Examples
    --------
    >>> registers("v[2:3], s4, vcc")
    ['v2', 'v3', 's4', 'vcc']
    """
    found = []
    for kind, one, first, last, special in REGISTER.findall(text):
        numbers = [int(one)] if one else range(int(first), int(last) + 1) if first else []
        found += [special] if special else [f"{kind}{k}" for k in numbers]
    return found


class WaveClock:
    """A wave alone on its SIMD, one instruction after the other."""

    def __init__(self, family: Family) -> None:
        self.family = family
        self.now = self.complex_free = self.loaded = 0.0
        self.ready: dict[str, float] = {}
        self.fetched: list[float] = []

    def wait(self, text: str) -> None:
        """Wait for what ``s_waitcnt`` names."""
        if left := re.search(r"vmcnt\((\d+)\)", text):
            self.now = max([self.now, *self.fetched[: max(len(self.fetched) - int(left[1]), 0)]])
        if "lgkmcnt" in text:
            self.now = max(self.now, self.loaded)

    def issue(self, name: str, operands: str) -> Cycles:
        """Issue an instruction, and return the cycles that it occupies."""
        family = self.family
        self.now = max([self.now, *(self.ready.get(one, 0.0) for one in registers(operands))])
        step, latency, spent = family.scalar, family.scalar + 1, Cycles()
        if name.startswith(FETCH):
            self.fetched.append(self.now + family.fetch_latency)
            spent = Cycles(fetch=family.fetch)
        elif name.startswith(("s_load", "s_buffer_load")):
            self.loaded = self.now + family.constant_latency
        elif COMPLEX.match(name):
            self.now = max(self.now, self.complex_free)
            self.complex_free = self.now + family.complex
            step = family.complex if family.shares_unit else family.valu
            latency, spent = family.complex_latency, Cycles(valu=step, complex=family.complex)
        elif name.startswith("v_"):
            step, latency, spent = family.valu, family.valu_latency, Cycles(valu=family.valu)
        for one in registers(operands.partition(",")[0]):
            self.ready[one] = self.now + latency
        self.now += step
        return spent


def block_cycles(block: Block, family: Family) -> Cycles:
    """Cycles of a block that all lanes enter at once; what it fetches is there at its end."""
    clock, total = WaveClock(family), Cycles()
    for line in block.lines:
        name, _, operands = line.partition(" ")
        if name == "s_waitcnt":
            clock.wait(operands)
        else:
            total = total.plus(clock.issue(name, operands), 1.0)
    return total.plus(Cycles(alone=max([clock.now, clock.loaded, *clock.fetched])), 1.0)


def per_pixel(cycles: Mapping[str, Cycles], waves: int, family: Family) -> dict[str, float]:
    """Cycles of a compute unit for a pixel, by what they are spent on, as if that were all."""
    total = Cycles()
    for part in cycles.values():
        total = total.plus(part, 1.0)
    return {
        "valu": total.valu / family.simds / LANES,
        "complex": total.complex / family.simds / LANES,
        "fetch": total.fetch / LANES,
        "waiting": total.alone / family.simds / waves / LANES,
    }
