"""The viewer: its page, on a server or in one file."""
