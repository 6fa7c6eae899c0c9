"""Published shapes within the limits of their server, on their number and bytes."""

from vexture.base.errors import LimitError
from vexture.server.limits import Limits
from vexture.server.published import PublishedShape, PublishedShapes


class FullError(LimitError):
    """There is no room for another shape."""


class LimitedShapes(PublishedShapes):
    """Published shapes: at most `Limits.max_shapes` shapes and `Limits.max_total` bytes."""

    def __init__(self, limits: Limits) -> None:
        super().__init__()
        self._limits = limits

    async def publish(self, shape: PublishedShape) -> None:
        """Publish a shape and notify all clients; raise as `check_room` does."""
        self.check_room(shape)
        self.add(shape)

    async def withdraw(self, name: str) -> None:
        """Remove a shape, and notify all clients."""
        self.remove(name)

    def check_room(self, shape: PublishedShape) -> None:
        """Raise a `FullError` if the shape would exceed the number of shapes or of bytes."""
        before = self.shape(shape.name)
        if before is None and len(self.names) >= self._limits.max_shapes:
            raise FullError(f"{shape.name}: there are {len(self.names)} shapes, the limit; replace one of them")
        new = {file.name: len(file.data) for file in shape.files}
        old = {file.name: len(file.data) for file in (before.files if before else ()) if self.owners(file.name) == 1}
        size = self.nbytes - sum(old[name] for name in old.keys() - new.keys())
        size += sum(new[name] for name in new if not self.owners(name))
        if size > self._limits.max_total:
            raise FullError(f"{shape.name}: all shapes then have {size} bytes; the limit is {self._limits.max_total}")
