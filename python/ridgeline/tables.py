# SPDX-License-Identifier: Apache-2.0
"""Results as tables, and the intervals of shares."""

import math


def to_pandas(arrays):
    """A dict of arrays of one length, or what has arrays() (a BenchResult), as pandas.DataFrame.

    Raises:
        ImportError: pandas is not installed; arrays() needs only NumPy.
    """
    import pandas

    if hasattr(arrays, "arrays"):
        arrays = arrays.arrays()
    return pandas.DataFrame(arrays)


def wilson_interval(hits, trials, z=1.959963984540054):
    """Wilson's 95 % interval (lower, upper) of a share; (0, 1) without trials.

    Trials are independent ones: of pictures that are localized with several seeds, the pictures.
    """
    if trials == 0:
        return 0.0, 1.0
    share = hits / trials
    middle = share + z * z / (2 * trials)
    reach = z * math.sqrt(share * (1 - share) / trials + z * z / (4 * trials * trials))
    scale = 1 + z * z / trials
    return max(0.0, (middle - reach) / scale), min(1.0, (middle + reach) / scale)
