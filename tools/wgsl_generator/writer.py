"""WGSL from a syntax tree, with its names, its order and its comments.

Uniforms become parameters, textures with their samplers too: a text then serves any number of textures in one program.
"""

import re
from collections.abc import Callable
from contextlib import contextmanager
from textwrap import wrap
from typing import Any, Final

from vexture.renderers.shader import ShaderError
from wgsl_generator.expressions import FRAGMENT_NAME, Expressions, Typed, shift_count, spread
from wgsl_generator.facts import Facts, assumed_in, changed_in, facts_of
from wgsl_generator.kinds import SAMPLED, SAMPLER, array_of, component_of, size_of, wgsl_name, wgsl_type
from wgsl_generator.syntax import (
    FRAGMENT,
    Assign,
    Block,
    Case,
    Conditional,
    Constant,
    Declare,
    Default,
    Define,
    Evaluate,
    Field,
    For,
    Function,
    If,
    Item,
    Jump,
    Member,
    Parameter,
    Remarks,
    Return,
    Statement,
    Step,
    Struct,
    Switch,
    Top,
    Uniform,
    While,
)

WIDTH: Final = 120
INDENT: Final = "    "
NO_BREAK: Final = "\0"  # instead of a space


def written(tree: tuple[Top | Conditional, ...]) -> str:
    """Return a syntax tree as WGSL; its conditionals stay, to be resolved by `vexture.renderers.shader.chosen`.

    Raises
    ------
    ShaderError
        With the line of what has no meaning in WGSL.
    """
    writer = Writer(facts_of(tree))
    for one in tree:
        writer.top(one)
    return "\n".join(writer.lines).strip() + "\n"


class Writer:
    """Writes line after line."""

    def __init__(self, facts: Facts) -> None:
        self.facts = facts
        self.expressions = Expressions(facts)
        self.lines: list[str] = []
        self.depth = 0
        self.changed: set[str] = set()
        self.returns = "void"

    @property
    def scope(self) -> dict[str, str]:
        """Types of the local names."""
        return self.expressions.scope

    # --- lines

    def emit(self, text: str, remarks: Remarks | None = None) -> None:
        """Write a line, and the comments beside it; what is too long goes on behind a sign or a comma."""
        self.comment(remarks or Remarks())
        *first, last = fold_lines(text, WIDTH - len(INDENT) * self.depth)
        trail = f"  {remarks.trail}" if remarks and remarks.trail else ""
        for k, line in enumerate((*first, last + trail)):
            self.lines.append(INDENT * (self.depth + (k > 0)) + line)

    def comment(self, remarks: Remarks) -> None:
        """Write the comments before something."""
        for comment in remarks.lead:
            if comment or (self.lines and self.lines[-1] and not self.lines[-1].endswith("{")):
                self.lines.append(INDENT * self.depth + comment if comment else "")

    @contextmanager
    def inside(self) -> Any:
        """Lines within braces, with local names of their own."""
        outer = dict(self.scope)
        self.depth += 1
        yield
        self.depth -= 1
        self.expressions.scope = outer

    def conditional(self, conditional: Conditional, one: Callable[[Any], None]) -> None:
        """Branches, each written under what holds there."""
        above = self.expressions.assumed
        self.comment(conditional.remarks)
        for k, branch in enumerate(conditional.branches):
            word = "#else" if branch.condition is None else f"#{'el' * (k > 0)}if {branch.condition}"
            self.lines.append(word)
            single = Conditional(conditional.line, Remarks(), conditional.branches[: k + 1])
            mine = list(assumed_in(single, above))[-len(branch.body) :] if branch.body else []
            for inner, here in mine:
                self.expressions.assumed = here
                one(inner)
        self.expressions.assumed = above
        self.lines.append("#endif")

    # --- outside of functions

    def top(self, node: Top | Conditional) -> None:
        match node:
            case Conditional():
                self.conditional(node, self.top)
            case Define():
                type_ = wgsl_type(self.facts.values[node.name])
                self.emit(f"const {node.name}: {type_} = {node.value.strip('()')};", node.remarks)
            case Default():  # for whoever chooses
                self.comment(node.remarks)
            case Uniform():
                self.uniform(node)
            case Constant():
                value = self.expressions.as_type(node.value, node.type, node.name)
                how = "const" if node.how == "const" else "var<private>"
                self.emit(f"{how} {wgsl_name(node.name)}: {wgsl_type(node.type)} = {value.text};", node.remarks)
            case Struct():
                self.emit(f"struct {node.name} {{", node.remarks)
                self.depth += 1
                for one in node.fields:
                    self.field(one)
                self.depth -= 1
                self.emit("}")
            case Function():
                self.function(node)

    def uniform(self, node: Uniform) -> None:
        """Of a uniform, which becomes a parameter, the comments stay."""
        comments = [comment for comment in node.remarks.lead if comment]
        comments += [f"// {node.name}: {node.remarks.trail.removeprefix('//').strip()}"] if node.remarks.trail else []
        for comment in comments:
            self.emit(comment)

    def field(self, node: Field | Conditional) -> None:
        if isinstance(node, Conditional):
            self.conditional(node, self.field)
        else:
            self.emit(f"{wgsl_name(node.name)}: {wgsl_type(node.type)},", node.remarks)

    def function(self, node: Function) -> None:
        form = self.facts.forms[node.name, len(node.parameters)]
        self.changed = changed_in(node, self.facts.forms)
        self.returns = node.returns
        self.expressions.scope = {one.name: one.type for one in node.parameters}
        self.expressions.pointers = {one.name for one in node.parameters if one.is_inout}
        copied = [one for one in node.parameters if one.name in self.changed and not one.is_inout]
        given = [self.declared(name, self.facts.uniforms[name]) for name in form.reads]
        given += [self.parameter(one, one in copied) for one in node.parameters]
        result = "" if node.returns == "void" else f" -> {wgsl_type(node.returns)}"
        head = f"fn {form.name}({', '.join(given)}){result} {{"
        if len(head) <= WIDTH:
            self.emit(head, node.remarks)
        else:
            self.emit(f"fn {form.name}(", Remarks(node.remarks.lead))
            whole = (one.replace(" ", NO_BREAK) for one in given)
            lines = wrap(f"{', '.join(whole)},", WIDTH, initial_indent=INDENT, subsequent_indent=INDENT)
            self.lines += [line.replace(NO_BREAK, " ") for line in lines]
            self.emit(f"){result} {{", Remarks((), node.remarks.trail))
        with self.inside():
            for one in copied:
                self.emit(f"var {wgsl_name(one.name)} = {one.name}_given;")
            self.items(node.body)
        self.emit("}")

    def declared(self, name: str, type_: str) -> str:
        """A uniform as a parameter."""
        if name == FRAGMENT:
            return f"{FRAGMENT_NAME}: {wgsl_type(type_)}"
        text = f"{wgsl_name(name)}: {wgsl_type(type_)}"
        return f"{text}, {wgsl_name(name)}{SAMPLER}: sampler" if type_ == SAMPLED else text

    def parameter(self, one: Parameter, is_copied: bool) -> str:
        if one.is_inout:
            return f"{wgsl_name(one.name)}: ptr<function, {wgsl_type(one.type)}>"
        return f"{one.name}_given: {wgsl_type(one.type)}" if is_copied else self.declared(one.name, one.type)

    # --- statements

    def items(self, body: tuple[Item, ...]) -> None:
        for one in body:
            self.item(one)

    def item(self, node: Item) -> None:
        if isinstance(node, Conditional):
            self.conditional(node, self.item)
        else:
            self.statement(node)

    def braced(self, head: str, body: tuple[Item, ...], remarks: Remarks | None = None) -> None:
        """A head, a body, and no end yet."""
        self.emit(f"{head} {{".lstrip(), remarks)
        with self.inside():
            self.items(body)

    def statement(self, node: Statement) -> None:
        match node:
            case If():
                self.if_(node)
            case While():
                condition = self.expressions.as_type(node.condition, "bool", "a condition")
                self.braced(f"while ({condition.text})", node.body, node.remarks)
                self.emit("}")
            case For():
                with self.inside():
                    self.depth -= 1
                    start = self.simple(node.start) if node.start else ""
                    condition = self.expressions.as_type(node.condition, "bool", "a condition")
                    head = f"for ({start}; {condition.text}; {self.simple(node.step)})"
                    self.braced(head, node.body, node.remarks)
                    self.emit("}")
                    self.depth += 1
            case Switch():
                self.switch(node)
            case Block():
                self.braced("", node.body, node.remarks)
                self.emit("}")
            case Return():
                self.return_(node)
            case Jump():
                self.emit(f"{node.word};", node.remarks)
            case _:
                self.emit(f"{self.simple(node)};", node.remarks)

    def if_(self, node: If) -> None:
        remarks, head = node.remarks, "if"
        while True:
            condition = self.expressions.as_type(node.condition, "bool", "a condition")
            self.braced(f"{head} ({condition.text})", node.yes, remarks)
            if len(node.no) != 1 or not isinstance(node.no[0], If):
                break
            node, head, remarks = node.no[0], "} else if", Remarks((), node.no[0].remarks.trail)
        if node.no:
            self.braced("} else", node.no)
        self.emit("}")

    def switch(self, node: Switch) -> None:
        value = self.expressions.of(node.value)
        if value.type not in ("int", "uint"):
            raise ShaderError(node.line, f"a switch of {value.type}; it must be int or uint")
        self.emit(f"switch ({value.text}) {{", node.remarks)
        with self.inside():
            for case in node.cases:
                self.case(case, value.type)
            if all(case.labels for case in node.cases):
                self.emit("default: {}")
        self.emit("}")

    def case(self, case: Case, type_: str) -> None:
        labels = [self.expressions.as_type(label, type_, "a label").text for label in case.labels]
        body = case.body[0].body if len(case.body) == 1 and isinstance(case.body[0], Block) else case.body
        if not body or not isinstance(body[-1], Return | Jump):
            raise ShaderError(case.line, "a case must end by return or break: WGSL's do not go on in the next")
        self.braced(f"case {', '.join(labels)}:" if labels else "default:", body)
        self.emit("}")

    def return_(self, node: Return) -> None:
        if node.value is None:
            return self.emit("return;", node.remarks)
        value = self.expressions.as_type(node.value, self.returns, "what is returned")
        return self.emit(f"return {value.text};", node.remarks)

    def simple(self, node: Statement) -> str:
        """A statement that may stand in the head of a loop."""
        match node:
            case Declare():
                return self.declare(node)
            case Assign():
                return self.assign(node)
            case Step():
                return self.expressions.of(node.target).text + node.sign
            case Evaluate():
                value = self.expressions.of(node.call)
                return value.text if value.type == "void" else f"_ = {value.text}"
            case _:
                raise ShaderError(node.line, "a declaration, an assignment or a call was expected")

    def declare(self, node: Declare) -> str:
        name, type_ = wgsl_name(node.name), wgsl_type(node.type)
        value = self.expressions.as_type(node.value, node.type, node.name) if node.value else None
        self.scope[node.name] = node.type
        is_fixed = value is not None and node.name not in self.changed and array_of(node.type) is None
        text = f"{'let' if is_fixed else 'var'} {name}: {type_}"
        return f"{text} = {value.text}" if value else text

    def assign(self, node: Assign) -> str:
        target, value = self.expressions.of(node.target), self.expressions.of(node.value)
        is_shift, is_scalar = node.sign in ("<<=", ">>="), value.type == component_of(target.type)
        if value.type != target.type and not (node.sign != "=" and is_scalar) and not is_shift:
            raise ShaderError(node.line, f"{target.text} is {target.type}, and is given {value.type}")
        if is_shift:
            value = shift_count(value, target.type)
        elif node.sign in ("&=", "|=", "^="):
            value = spread(value, target.type)
        if isinstance(node.target, Member) and len(node.target.name) > 1 and size_of(target.type) > 1:
            whole = self.expressions.of(node.target.value)
            if size_of(whole.type) > 1 and len(node.target.name) == size_of(target.type):
                return self.components(node, whole, value)
        return f"{target.text} {node.sign} {value.text}"

    def components(self, node: Assign, whole: Typed, value: Typed) -> str:
        """Several components of a vector, which WGSL cannot assign: all of it is."""
        assert isinstance(node.target, Member)
        names = "rgba" if node.target.name[0] in "rgba" else "xyzw"
        first, last = names.index(node.target.name[0]), names.index(node.target.name[-1])
        if node.target.name != names[first : last + 1]:
            raise ShaderError(node.line, f".{node.target.name}: only components that follow each other can be assigned")
        part = f"{whole.text}.{node.target.name}"
        new = value.text if node.sign == "=" else f"{part} {node.sign[:-1]} ({value.text})"
        before = [f"{whole.text}.{name}" for name in names[:first]]
        after = [f"{whole.text}.{name}" for name in names[last + 1 : size_of(whole.type)]]
        return f"{whole.text} = {wgsl_type(whole.type)}({', '.join([*before, new, *after])})"


def fold_lines(text: str, room: int) -> list[str]:
    """A statement as lines, cut where the fewest brackets are open."""
    if len(text) <= room or text.startswith("//"):
        return [text]
    cuts = [match.start() + 1 for match in re.finditer(r" (?:\|\||&&|[-+*]) |(?<=,) ", text) if match.start() < room]
    if not cuts:
        return [text]
    cut = min(reversed(cuts), key=lambda at: text[:at].count("(") - text[:at].count(")"))
    return [text[:cut].rstrip(), *fold_lines(text[cut:].lstrip(), room - len(INDENT))]
