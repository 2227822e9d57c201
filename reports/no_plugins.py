# SPDX-License-Identifier: BSD-3-Clause
"""Whoever imports this before h5py reads HDF5 without plugins: a third-party file can name a filter, and HDF5 would run
the code of that name which lies on this machine.

Programs import it, and readers that others use do not: a user's own Python may have filters that the user wants.
"""

import os

os.environ["HDF5_PLUGIN_PRELOAD"] = "::"  # HDF5's word for none, which it reads as it starts
