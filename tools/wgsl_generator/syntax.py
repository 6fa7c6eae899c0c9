"""The syntax tree of a shader's text.

Names of types are those of GLSL, as ``uvec4`` or ``vec2[3]``. All nodes know the line where they begin. A
`Conditional`, ``#if``, stands wherever its branches hold whole declarations, fields or statements.
"""

from dataclasses import dataclass
from typing import Final, Literal, TypeAlias

FRAGMENT: Final = "gl_FragCoord"
"""The fragment's place: what else a shader is given, it is given by uniforms."""


@dataclass(frozen=True, slots=True)
class Number:
    """A literal, or ``true`` or ``false``."""

    line: int
    text: str


@dataclass(frozen=True, slots=True)
class Name:
    """A variable."""

    line: int
    text: str


@dataclass(frozen=True, slots=True)
class Call:
    """A function or a constructor, and what it is given."""

    line: int
    name: str
    given: "tuple[Expression, ...]"


@dataclass(frozen=True, slots=True)
class Array:
    """An array's constructor."""

    line: int
    type: str
    given: "tuple[Expression, ...]"


@dataclass(frozen=True, slots=True)
class Unary:
    """A sign before a value."""

    line: int
    sign: str
    value: "Expression"


@dataclass(frozen=True, slots=True)
class Binary:
    """A sign between two values."""

    line: int
    sign: str
    left: "Expression"
    right: "Expression"


@dataclass(frozen=True, slots=True)
class Choice:
    """``condition ? yes : no``."""

    line: int
    condition: "Expression"
    yes: "Expression"
    no: "Expression"


@dataclass(frozen=True, slots=True)
class Member:
    """A field of a structure, or components of a vector."""

    line: int
    value: "Expression"
    name: str


@dataclass(frozen=True, slots=True)
class Index:
    """An element of an array, a component of a vector, or a column of a matrix."""

    line: int
    value: "Expression"
    at: "Expression"


Expression: TypeAlias = Number | Name | Call | Array | Unary | Binary | Choice | Member | Index


@dataclass(frozen=True, slots=True)
class Remarks:
    """The comments beside something: on lines of their own before it, and behind its end."""

    lead: tuple[str, ...] = ()
    trail: str = ""


@dataclass(frozen=True, slots=True)
class Declare:
    """A variable within a function; its type says its size if it is an array."""

    line: int
    remarks: Remarks
    type: str
    name: str
    value: Expression | None


@dataclass(frozen=True, slots=True)
class Assign:
    """``target = value``, or with another sign, as ``+=``."""

    line: int
    remarks: Remarks
    target: Expression
    sign: str
    value: Expression


@dataclass(frozen=True, slots=True)
class Step:
    """``target++`` or ``target--``."""

    line: int
    remarks: Remarks
    target: Expression
    sign: str


@dataclass(frozen=True, slots=True)
class Evaluate:
    """A call whose value nobody wants."""

    line: int
    remarks: Remarks
    call: Call


@dataclass(frozen=True, slots=True)
class Return:
    """The end of a function."""

    line: int
    remarks: Remarks
    value: Expression | None


@dataclass(frozen=True, slots=True)
class Jump:
    """``break`` or ``continue``."""

    line: int
    remarks: Remarks
    word: str


@dataclass(frozen=True, slots=True)
class Block:
    """Statements in braces."""

    line: int
    remarks: Remarks
    body: "tuple[Item, ...]"


@dataclass(frozen=True, slots=True)
class If:
    """``if``; what follows ``else`` may be one other `If`. The second remarks are those behind ``else``."""

    line: int
    remarks: Remarks
    condition: Expression
    yes: "tuple[Item, ...]"
    no: "tuple[Item, ...]"


@dataclass(frozen=True, slots=True)
class While:
    """``while``."""

    line: int
    remarks: Remarks
    condition: Expression
    body: "tuple[Item, ...]"


@dataclass(frozen=True, slots=True)
class For:
    """``for``."""

    line: int
    remarks: Remarks
    start: "Statement | None"
    condition: Expression
    step: "Statement"
    body: "tuple[Item, ...]"


@dataclass(frozen=True, slots=True)
class Case:
    """Labels of a `Switch`, none for ``default``, and what they lead to; it ends by itself."""

    line: int
    labels: tuple[Expression, ...]
    body: "tuple[Item, ...]"


@dataclass(frozen=True, slots=True)
class Switch:
    """``switch``."""

    line: int
    remarks: Remarks
    value: Expression
    cases: tuple[Case, ...]


Statement: TypeAlias = Declare | Assign | Step | Evaluate | Return | Jump | Block | If | While | For | Switch


@dataclass(frozen=True, slots=True)
class Define:
    """``#define NAME NUMBER``."""

    line: int
    remarks: Remarks
    name: str
    value: str


@dataclass(frozen=True, slots=True)
class Default:
    """A number that a program may choose, and its value otherwise."""

    line: int
    remarks: Remarks
    name: str
    value: str


@dataclass(frozen=True, slots=True)
class Uniform:
    """A value or a texture that a program is given."""

    line: int
    remarks: Remarks
    type: str
    name: str


@dataclass(frozen=True, slots=True)
class Constant:
    """A constant, or a global that functions change."""

    line: int
    remarks: Remarks
    how: Literal["const", "private"]
    type: str
    name: str
    value: Expression


@dataclass(frozen=True, slots=True)
class Field:
    """A field of a structure."""

    line: int
    remarks: Remarks
    type: str
    name: str


@dataclass(frozen=True, slots=True)
class Struct:
    """A structure."""

    line: int
    remarks: Remarks
    name: str
    fields: "tuple[Field | Conditional, ...]"


@dataclass(frozen=True, slots=True)
class Parameter:
    """A parameter of a function, which may change it for its caller if it is ``inout``."""

    type: str
    name: str
    is_inout: bool


@dataclass(frozen=True, slots=True)
class Function:
    """A function; the trailing remark is that behind its opening brace."""

    line: int
    remarks: Remarks
    returns: str
    name: str
    parameters: tuple[Parameter, ...]
    body: "tuple[Item, ...]"


Top: TypeAlias = Define | Default | Uniform | Constant | Struct | Function


@dataclass(frozen=True, slots=True)
class Branch:
    """Lines under a condition, ``NAME`` or ``NAME == VALUE``; None for ``#else``."""

    condition: str | None
    body: "tuple[Item | Top | Field, ...]"


@dataclass(frozen=True, slots=True)
class Conditional:
    """``#if`` to ``#endif``."""

    line: int
    remarks: Remarks
    branches: tuple[Branch, ...]


Item: TypeAlias = Statement | Conditional
