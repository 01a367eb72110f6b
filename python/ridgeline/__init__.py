# SPDX-License-Identifier: Apache-2.0
"""ridgeline: the 6-DoF pose of a photo from a LoD2 city model.

    import ridgeline

    found = ridgeline.localize("photo.jpg", "city.gml", dtm="dtm.tif")
    print(found.pose, found.confidence)

World coordinates are easting, northing, height [m] in the model's system, float64. Poses are
cam_from_world with unit quaternions in the order x, y, z, w, as in pycolmap; camera axes are x
right, y down, z forward. Pictures are arrays in the order blue, green, red, as OpenCV reads them;
pixel (0, 0) is the upper left corner of the upper left pixel, as in COLMAP. Arrays must be
C-contiguous, of the dtype that is asked for, and finite: nothing is converted behind the caller's
back. Input that cannot be used is an InputError in the words of the program; Ctrl-C ends a long
call with KeyboardInterrupt.
"""

from pathlib import Path as _Path

from . import _ridgeline
from ._ridgeline import *  # noqa: F401,F403
from ._ridgeline import Options, __version__
from .tables import to_pandas, wilson_interval

__all__ = [name for name in dir(_ridgeline) if not name.startswith("_")]
__all__ += ["to_pandas", "wilson_interval", "shipped_options", "__version__"]


def shipped_options(name):
    """Options of a configuration that comes with ridgeline.

    Args:
        name: "default", "paper", "skyline", "drone", ...: a file of configs/ without ".json".
    Raises:
        InputError: there is none of that name.
    """
    return Options(_Path(__file__).parent / "configs" / f"{name}.json")
