"""Random filters with extreme numbers end, quietly, with colours or in one line."""

from random import Random

import numpy as np
import pytest

from vexture.base.errors import VextureError
from vexture.drawing.group import Blend
from vexture.svg.filter_frame import PixelFrame, Rectangle
from vexture.svg.filter_operations import (
    Blending,
    ColorMatrix,
    ComponentTransfer,
    Convolution,
    Displacement,
    DistantLight,
    GaussianBlur,
    Lighting,
    LightSource,
    Morphology,
    Operation,
    PointLight,
    PorterDuff,
    RasterStep,
    Repetition,
    Shift,
    SolidColor,
    SpotLight,
    Stack,
    TransferCurve,
    Turbulence,
)
from vexture.svg.filter_raster import evaluate

EXTREMES = [0.0, -0.0, 1.0, -1.0, 0.5, 3.7, -7.3, 33.3, 255.0, 5e-324, -1e-300, 1e-9, 1e8, 1e14, 1e15, -1e15]
FRAMES = [
    PixelFrame(0.0, 0.0, 1.0, 1.0, 13, 11),
    PixelFrame(-1e6, 3.3, 0.01, 0.7, 13, 11),
    PixelFrame(1e12, 1e12, 1e9, 1e-9, 13, 11),
    PixelFrame(-5.0, -5.0, 1e-9, 1e12, 13, 11),
]
NAMES = ["", "a", "b", "SourceGraphic", "SourceAlpha", "unknown"]


class Extremes:
    """Random operations with extreme numbers."""

    def __init__(self, seed: int) -> None:
        self.random = Random(seed)

    def some(self, count: int) -> tuple[float, ...]:
        return tuple(self.random.choice(EXTREMES) for _ in range(count))

    def flag(self) -> bool:
        return self.random.random() < 0.5

    def rectangle(self) -> Rectangle | None:
        return self.random.choice([None, self.some(4), (1.2, 2.3, 7.5, 9.1)])

    def light(self) -> LightSource:
        spot = SpotLight(self.some(3), self.some(3), *self.some(1), self.random.choice([None, *self.some(1)]))
        return self.random.choice([DistantLight(*self.some(2)), PointLight(self.some(3)), spot])

    def lengths(self) -> tuple[float, ...]:
        return tuple(abs(number) or 1.0 for number in self.some(2))

    def convolution(self) -> Convolution:
        columns, rows = self.random.randint(1, 4), self.random.randint(1, 4)
        target = self.random.randrange(columns), self.random.randrange(rows)
        edges = self.random.choice(["none", "wrap", "duplicate"])
        matrix = self.some(columns * rows)
        return Convolution((columns, rows), matrix, *self.some(2), target, edges, self.flag(), self.lengths())

    def curve(self) -> TransferCurve:
        kind = self.random.choice(["identity", "table", "discrete", "linear", "gamma"])
        return TransferCurve(kind, self.some(self.random.randint(0, 4)), *self.some(3))

    def operation(self) -> Operation:
        random, some = self.random, self.some
        octaves = random.choice([0, -3, 1, 4, 10**9])
        operator = random.choice(["over", "in", "out", "atop", "xor", "lighter", "arithmetic"])
        exponent = random.choice([None, *some(1)])
        return random.choice(
            [
                Turbulence(some(2), octaves, *some(1), self.flag(), self.flag()),
                Lighting(self.light(), some(3), *some(2), exponent, self.lengths()),
                self.convolution(),
                Displacement(*some(1), (random.randrange(4), random.randrange(4))),
                Morphology(some(2), self.flag()),
                GaussianBlur(some(2)),
                ColorMatrix(some(20)),
                ComponentTransfer((self.curve(), self.curve(), self.curve(), self.curve())),
                PorterDuff(operator, some(4)),
                Blending(random.choice(list(Blend))),
                Shift(*some(2)),
                Repetition(),
                SolidColor(some(4)),
                Stack(),
            ]
        )

    def step(self) -> RasterStep:
        inputs = tuple(self.random.choice(NAMES) for _ in range(self.random.randint(0, 3)))
        return RasterStep(self.operation(), inputs, self.random.choice(["", "a", "b"]), self.rectangle(), self.flag())


@pytest.mark.parametrize("seed", range(8))
def test_filters_with_extreme_numbers_end(seed: int) -> None:
    extremes, messages = Extremes(seed), list[str]()
    source = np.random.default_rng(seed).random((13, 11, 4))
    source[3:6] = 0.0
    source[..., :3] *= source[..., 3:]
    for _ in range(50):
        steps = [extremes.step() for _ in range(extremes.random.randint(1, 5))]
        try:
            found = evaluate(steps, {"SourceGraphic": source}, extremes.random.choice(FRAMES), extremes.rectangle())
        except VextureError as error:
            messages.append(str(error))
            continue
        assert found.shape == source.shape
        assert (found >= 0.0).all()
        assert (found[..., 3] <= 1.0).all()
        assert (found[..., :3] <= found[..., 3:]).all()
    assert len(messages) < 10
    assert not any("\n" in message for message in messages)
