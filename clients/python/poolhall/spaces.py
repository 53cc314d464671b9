"""Gymnasium's spaces where it is installed, and small ones that behave alike where it is not."""
from __future__ import annotations

from typing import Any, Dict as _Dict, Mapping, Optional, Sequence

import numpy as np

try:
    from gymnasium.spaces import Box, Dict, Discrete, MultiBinary
    from gymnasium.vector.utils import batch_space
    HAS_GYMNASIUM = True
except ImportError:
    HAS_GYMNASIUM = False

    class _Space:
        """A set of values: `sample()`, `contains(x)` or `x in space`, `seed(n)`."""

        def __init__(self, shape: Optional[tuple], dtype: Any, seed: Any = None):
            self.shape = shape
            self.dtype = None if dtype is None else np.dtype(dtype)
            self.np_random = np.random.default_rng(seed)

        def seed(self, seed: Optional[int] = None) -> None:
            self.np_random = np.random.default_rng(seed)

        def __contains__(self, value: Any) -> bool:
            return self.contains(value)

        def __eq__(self, other: Any) -> bool:
            return type(self) is type(other) and repr(self) == repr(other)

        __hash__ = object.__hash__

    class Box(_Space):  # type: ignore[no-redef]
        """Arrays between `low` and `high`."""

        def __init__(self, low: Any, high: Any, shape: Optional[Sequence[int]] = None,
                     dtype: Any = np.float64, seed: Any = None):
            shape = tuple(np.broadcast_shapes(np.shape(low), np.shape(high))
                          if shape is None else shape)
            super().__init__(shape, dtype, seed)
            self.low = np.broadcast_to(np.asarray(low, self.dtype), shape).copy()
            self.high = np.broadcast_to(np.asarray(high, self.dtype), shape).copy()

        def sample(self) -> np.ndarray:
            return self.np_random.uniform(self.low, self.high).astype(self.dtype)

        def contains(self, value: Any) -> bool:
            array = np.asarray(value)
            return (array.shape == self.shape and np.can_cast(array.dtype, self.dtype)
                    and bool(np.all(array >= self.low) and np.all(array <= self.high)))

        def __repr__(self) -> str:
            return f"Box({self.low.min()}, {self.high.max()}, {self.shape}, {self.dtype})"

    class Discrete(_Space):  # type: ignore[no-redef]
        """Integers 0 to n - 1."""

        def __init__(self, n: int, seed: Any = None):
            super().__init__((), np.int64, seed)
            self.n = n

        def sample(self) -> np.int64:
            return np.int64(self.np_random.integers(self.n))

        def contains(self, value: Any) -> bool:
            is_whole = np.shape(value) == () and np.issubdtype(np.asarray(value).dtype, np.integer)
            return bool(is_whole and 0 <= value < self.n)

        def __repr__(self) -> str:
            return f"Discrete({self.n})"

    class MultiBinary(_Space):  # type: ignore[no-redef]
        """Arrays of n zeros and ones."""

        def __init__(self, n: Any, seed: Any = None):
            super().__init__((n,) if isinstance(n, int) else tuple(n), np.int8, seed)
            self.n = n

        def sample(self) -> np.ndarray:
            return self.np_random.integers(0, 2, self.shape, self.dtype)

        def contains(self, value: Any) -> bool:
            array = np.asarray(value)
            return array.shape == self.shape and bool(np.all((array == 0) | (array == 1)))

        def __repr__(self) -> str:
            return f"MultiBinary({self.n})"

    class Dict(_Space):  # type: ignore[no-redef]
        """Named values, each of a space of its own."""

        def __init__(self, spaces: Mapping[str, Any], seed: Any = None):
            super().__init__(None, None, seed)
            self.spaces: _Dict[str, Any] = dict(spaces)

        def seed(self, seed: Optional[int] = None) -> None:
            super().seed(seed)
            for space, own in zip(self.spaces.values(),
                                  np.random.SeedSequence(seed).spawn(len(self.spaces))):
                space.seed(own)

        def sample(self) -> dict:
            return {key: space.sample() for key, space in self.spaces.items()}

        def contains(self, value: Any) -> bool:
            return (isinstance(value, Mapping) and value.keys() == self.spaces.keys()
                    and all(value[key] in space for key, space in self.spaces.items()))

        def __getitem__(self, key: str) -> Any:
            return self.spaces[key]

        def __repr__(self) -> str:
            inside = ", ".join(f"{key!r}: {space}" for key, space in self.spaces.items())
            return f"Dict({inside})"

    class MultiDiscrete(_Space):
        """Arrays of integers, 0 to nvec - 1 each: a batch of Discrete."""

        def __init__(self, nvec: Any, seed: Any = None):
            self.nvec = np.asarray(nvec, np.int64)
            super().__init__(self.nvec.shape, np.int64, seed)

        def sample(self) -> np.ndarray:
            return self.np_random.integers(0, self.nvec)

        def contains(self, value: Any) -> bool:
            array = np.asarray(value)
            return (array.shape == self.shape and np.issubdtype(array.dtype, np.integer)
                    and bool(np.all((array >= 0) & (array < self.nvec))))

        def __repr__(self) -> str:
            return f"MultiDiscrete({self.nvec})"

    def batch_space(space: Any, n: int = 1) -> Any:
        """The space of n values of `space` at once."""
        if isinstance(space, Dict):
            return Dict({key: batch_space(part, n) for key, part in space.spaces.items()})
        if isinstance(space, Discrete):
            return MultiDiscrete(np.full(n, space.n))
        if isinstance(space, MultiBinary):
            return Box(0, 1, (n, *space.shape), np.int8)
        return Box(np.broadcast_to(space.low, (n, *space.shape)),
                   np.broadcast_to(space.high, (n, *space.shape)), dtype=space.dtype)
