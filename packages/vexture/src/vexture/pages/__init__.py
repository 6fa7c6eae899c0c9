"""The viewer: its page, served by a server or saved in one file."""
