"""What can go wrong, one class for each decision that a user can take.

Every message is one line that names the value, the limit and the remedy. The command line prints that line and
exits with code 1; any other exception that reaches a user is a bug.
"""

__all__ = ["DeviceError", "FormatError", "LimitError", "SourceError", "SourceWarning", "VextureError"]


class VextureError(Exception):
    """Base of all errors that vexture raises on purpose."""


class SourceError(VextureError):
    """The drawing cannot be read: correct the source file."""


class FormatError(VextureError):
    """The texture file is damaged or of another format: convert the drawing again."""


class LimitError(VextureError):
    """A limit is exceeded: change the parameter that the message names."""


class DeviceError(VextureError):
    """The GPU, its driver or the disk refuses: use another renderer or another place."""


class SourceWarning(UserWarning):
    """Something in the drawing is not supported and was left out or simplified."""
