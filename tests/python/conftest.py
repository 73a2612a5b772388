import os
import pathlib
import sys

import numpy as np
import pytest

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from needs import needs  # noqa: E402, F401: for the tests

PROGRAM = os.environ["SANDSTROKE_PROGRAM"]
SOURCE = pathlib.Path(os.environ["SANDSTROKE_SOURCE"])

SMALL = {
    "bed": {"size": [0.2, 0.12], "cells": [100, 60]},
    "model": {"preset": "accurate"},
    "tool": {"radius": 0.01},
}


@pytest.fixture
def small():
    """A scene without a stroke."""
    return {section: dict(keys) for section, keys in SMALL.items()}


@pytest.fixture
def line():
    """A straight drag 3 mm deep: time, x, y, z."""
    time = np.arange(0.0, 0.4, 1e-3)
    return np.column_stack([time, -0.05 + 0.25 * time, 0.0 * time, np.full_like(time, -0.003)])
