"""A shelf that others publish on: it takes so many shapes and so many bytes."""

from vexture.errors import LimitError
from vexture.live.limits import Limits
from vexture.live.shelf import Shape, Shelf

__all__ = ["FullError", "LimitedShelf"]


class FullError(LimitError):
    """There is no room for a shape: remove others or raise the limit."""


class LimitedShelf(Shelf):
    """Shapes in memory, within limits; they end with their server.

    Parameters
    ----------
    limits : Limits
        Its ``shapes`` and ``total_bytes`` are kept to.
    """

    def __init__(self, limits: Limits) -> None:
        super().__init__()
        self._limits = limits

    async def publish(self, shape: Shape) -> None:
        """Keep a shape and tell everyone of it.

        Raises
        ------
        FullError
            If there are too many shapes, or too many bytes.
        """
        self.make_sure_of_room(shape)
        self.put(shape)

    def make_sure_of_room(self, shape: Shape) -> None:
        """Raise a `FullError` if there would be too many shapes, or too many bytes."""
        before = self.shape(shape.name)
        if before is None and len(self.names) >= self._limits.shapes:
            raise FullError(f"{shape.name}: there are {len(self.names)} shapes, the limit; replace one of them")
        new = {file.name: len(file.data) for file in shape.files}
        old = {file.name: len(file.data) for file in (before.files if before else ()) if self.owners(file.name) == 1}
        size = self.nbytes - sum(old[name] for name in old.keys() - new.keys())
        size += sum(new[name] for name in new if not self.owners(name))
        if size > self._limits.total_bytes:
            raise FullError(f"{shape.name}: all shapes then have {size} bytes; the limit is {self._limits.total_bytes}")
