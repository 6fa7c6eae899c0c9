"""Types of TypeScript as text of a page, with links to what is described."""

import html
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

__all__ = ["Model", "Writer", "plain"]

Model = dict[str, Any]

TRIVIAL: Final = {"ArrayBufferLike", "ArrayBuffer"}
"""Arguments of a type that say nothing to a reader: they are its default."""

COMPOUND: Final = {"union", "intersection", "conditional", "typeOperator"}


def plain(text: str) -> str:
    """Return text for the inside of an HTML element in Markdown, in which nothing is markup."""
    escaped = html.escape(text, quote=False)
    return "".join(f"&#{ord(one)};" if one in "*_[]`\\|" else one for one in escaped)


def _has_default(one: Model) -> bool:
    """Whether a parameter may be left out; TypeDoc names the value of a property, too."""
    return one["variant"] == "param" and "defaultValue" in one


@dataclass(frozen=True, slots=True)
class Writer:
    """Writes types.

    Parameters
    ----------
    link : callable
        Address of the description of a type that is named, None if there is none.
    """

    link: Callable[[Model], str | None]

    def type(self, what: Model | None) -> str:
        """Return a type as HTML."""
        if what is None:
            return "any"
        written: str = getattr(self, f"_{what['type']}", self._other)(what)
        return written

    def parameters(self, signature: Model, separator: str = ", ") -> str:
        """Return the parameters of a function as HTML."""
        return separator.join(map(self._parameter, signature.get("parameters", [])))

    def generics(self, signature: Model) -> str:
        """Return the type parameters of a class or function as HTML."""
        found = []
        for one in signature.get("typeParameters", []):
            within = f" extends {self.type(one['type'])}" if "type" in one else ""
            default = f" = {self.type(one['default'])}" if "default" in one else ""
            found.append(plain(one["name"]) + within + default)
        return f"&lt;{', '.join(found)}&gt;" if found else ""

    def _parameter(self, one: Model) -> str:
        rest = "..." if one["flags"].get("isRest") else ""
        optional = "?" if one["flags"].get("isOptional") or _has_default(one) else ""
        return f"{rest}{plain(one['name'])}{optional}: {self.type(one['type'])}"

    def _other(self, what: Model) -> str:
        return plain(str(what.get("name", "unknown")))

    def _literal(self, what: Model) -> str:
        value = what["value"]
        return plain("null" if value is None else f"'{value}'" if isinstance(value, str) else str(value).lower())

    def _reference(self, what: Model) -> str:
        name, address = plain(what["name"]), self.link(what)
        shown = f'<a href="{address}">{name}</a>' if address else name
        given = [one for one in what.get("typeArguments", []) if one.get("name") not in TRIVIAL]
        if what["name"] == "VectorTexture":
            given = [one for one in given if one.get("name") != "PackedData"]  # its default
        return shown + (f"&lt;{', '.join(map(self.type, given))}&gt;" if given else "")

    def _union(self, what: Model) -> str:
        return plain(" | ").join(map(self._part, what["types"]))

    def _intersection(self, what: Model) -> str:
        return " &amp; ".join(map(self._part, what["types"]))

    def _part(self, what: Model) -> str:
        """Return a type as part of another one."""
        is_function = what["type"] == "reflection" and "signatures" in what["declaration"]
        return f"({self.type(what)})" if is_function or what["type"] in COMPOUND else self.type(what)

    def _array(self, what: Model) -> str:
        return self._part(what["elementType"]) + plain("[]")

    def _tuple(self, what: Model) -> str:
        return plain("[") + ", ".join(map(self.type, what.get("elements", []))) + plain("]")

    def _typeOperator(self, what: Model) -> str:  # noqa: N802 - the kinds are TypeDoc's
        return f"{what['operator']} {self.type(what['target'])}"

    def _indexedAccess(self, what: Model) -> str:  # noqa: N802
        return self.type(what["objectType"]) + plain("[") + self.type(what["indexType"]) + plain("]")

    def _query(self, what: Model) -> str:
        return f"typeof {self.type(what['queryType'])}"

    def _predicate(self, what: Model) -> str:
        return f"{plain(what['name'])} is {self.type(what.get('targetType'))}"

    def _conditional(self, what: Model) -> str:
        parts = (self.type(what[name]) for name in ("checkType", "extendsType", "trueType", "falseType"))
        return "{} extends {} ? {} : {}".format(*parts)

    def _reflection(self, what: Model) -> str:
        declared = what["declaration"]
        if "signatures" in declared:
            (first, *_) = declared["signatures"]
            return f"({self.parameters(first)}) =&gt; {self.type(first['type'])}"
        parts = [self._parameter(one) for one in declared.get("children", []) if "type" in one]
        for one in declared.get("indexSignatures", []):
            (key,) = one["parameters"]
            parts.append(f"{plain('[')}{self._parameter(key)}{plain(']')}: {self.type(one['type'])}")
        return "{ " + ", ".join(parts) + " }" if parts else "{}"
