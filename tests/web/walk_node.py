"""What the package's JavaScript finds in textures, by scripts of this folder, and the points that it is asked about."""

import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray


def points() -> NDArray[np.float64]:
    """Points at random, on the lines of the cells, on the border and beyond it."""
    random = np.random.default_rng(4)
    lines = random.integers(0, 257, (300, 2)) / 256
    mixed = np.stack([random.random(300), random.integers(0, 65, 300) / 64], axis=1)
    return np.concatenate([random.random((3000, 2)), lines, mixed, mixed[:, ::-1], random.random((50, 2)) * 3 - 1])


def by_node(script: str, *arguments: Path) -> Any:
    """What a script prints as JSON."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("no node (on Debian: apt-get install nodejs)")
    command = [node, Path(__file__).with_name(script), *arguments]
    outcome = subprocess.run(command, capture_output=True, text=True, check=False)
    assert outcome.returncode == 0, outcome.stderr
    return json.loads(outcome.stdout)


def found_at(texture: Path, at: NDArray[np.float64], folder: Path) -> list[dict[str, Any]]:
    """What is found of each shape of a texture, and at points of it."""
    listed = folder / "points.json"
    listed.write_text(json.dumps(at.tolist()), encoding="utf-8")
    found: list[dict[str, Any]] = by_node("walk_points.mjs", texture, listed)
    return found
