"""All tests run kernels as the command does; compiled code is kept in the user's own cache between runs."""

from graphfx.lanes.host import use_wide_registers

use_wide_registers()
