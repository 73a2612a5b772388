import importlib
import os

import pytest


def needs(module):
    """A module of somebody else's; where it is missing the test is skipped, in continuous integration it fails."""
    try:
        return importlib.import_module(module)
    except ImportError:
        message = f"the Python module {module} is not installed; tools/setup installs it"
        if os.environ.get("CI"):
            pytest.fail(message)
        pytest.skip(message, allow_module_level=True)
