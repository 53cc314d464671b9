"""What can go wrong, with the same codes as on the wire (protocol/README.md, "Errors")."""
from __future__ import annotations

from typing import Optional

__all__ = ["Error"]


class Error(Exception):
    """Something was refused: by the package, by the referee, or by a server.

    Attributes:
        code: stable name, such as "bad_shot" or "invalid_params"; the wire's `data.code`.
        number: the wire's number of that code, such as -32009.
        reason: one line: what came and what was expected.
        field: JSON Pointer to what was wrong. It begins with the argument's name, as
            "/balls/3/x" or "/shot/v"; from a server it points into the line that was sent.
        fault: the simulator's or referee's own word where it is more exact than `code`, such as
            "miscue", "cue_obstructed", "overlap"; else None.
        retryable: whether the same request may succeed later without being changed.
        game: the server's game, if the error is about one.
        foul: this refusal was the turn's last one: a foul, and the turn is over.
    """

    def __init__(self, code: str, reason: str, field: str = "", fault: Optional[str] = None,
                 game: Optional[int] = None, foul: bool = False,
                 number: Optional[int] = None, retryable: Optional[bool] = None):
        known = _registry().get(code)
        self.code = code
        self.reason = reason
        self.field = field
        self.fault = fault
        self.game = game
        self.foul = foul
        self.number = number if number is not None else known[0] if known else None
        self.retryable = retryable if retryable is not None else bool(known and known[1])
        super().__init__(f"{code}: {reason}" + (f" ({field})" if field else ""))

    def __reduce__(self):
        return (Error, (self.code, self.reason, self.field, self.fault, self.game, self.foul,
                        self.number, self.retryable))

    @classmethod
    def from_wire(cls, error: dict) -> "Error":
        """From the `error` member of a JSON-RPC answer."""
        data = error.get("data") or {}
        code = str(data.get("code", "internal"))
        reason = str(error.get("message", ""))
        reason = reason[len(code) + 2:] if reason.startswith(code + ": ") else reason
        return cls(code, reason, str(data.get("field", "")), None, data.get("game"),
                   bool(data.get("foul", False)), error.get("code"),
                   bool(data.get("retryable", False)))


def _registry() -> dict:
    from . import _core
    return {name: (number, retryable) for number, name, retryable, _ in _core.error_registry}
