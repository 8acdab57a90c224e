"""A compiled program as bytes: what the cache keeps and what a CPU device loads."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any, NamedTuple

from zeroset.runtime.device import Signature


class Compiled(NamedTuple):
    """A program as it lies on disk.

    Attributes:
        signature: what a caller binds.
        width: lanes of a packet.
        kind: ``image`` (runs wherever it is put) or ``object`` (needs a linker).
        code: the machine code.
    """

    signature: Signature
    width: int
    kind: str
    code: bytes

    def to_bytes(self) -> bytes:
        """The file's content."""
        head = json.dumps({"signature": self.signature.to_json(), "width": self.width, "kind": self.kind}).encode()
        return len(head).to_bytes(4, "little") + head + self.code

    @classmethod
    def from_bytes(cls, data: bytes) -> Compiled:
        """What ``to_bytes`` wrote; raises ``ValueError``, ``KeyError`` or ``TypeError`` on anything else."""
        size = int.from_bytes(data[:4], "little")
        head: Mapping[str, Any] = json.loads(data[4 : 4 + size])
        return cls(Signature.from_json(head["signature"]), int(head["width"]), str(head["kind"]), data[4 + size :])
