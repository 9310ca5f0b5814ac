# What cffi makes of the public headers: ffi and lib have the C names, which no type checker can see into.
from typing import Any

ffi: Any
lib: Any
