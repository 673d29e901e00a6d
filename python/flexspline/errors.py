"""What can go wrong, for people."""

from __future__ import annotations


class Error(Exception):
    """A failure: what is wrong, by name and value, and what to do about it.

    Attributes:
        code: exit code that the command line would give (65 bad data, 66 input missing, ...).
        problem: what is wrong.
        remedy: what to do about it; may be empty.
    """

    def __init__(self, code: int, problem: str, remedy: str, message: str) -> None:
        super().__init__(message)
        self.code = code
        self.problem = problem
        self.remedy = remedy
