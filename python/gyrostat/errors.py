# SPDX-License-Identifier: BSD-3-Clause
"""What gyrostat raises."""

from dataclasses import dataclass

__all__ = ["Cancelled", "ConvergenceError", "DomainError", "Mistake", "Refused", "SceneError"]


class DomainError(ValueError):
    """An argument is outside the domain of what was asked; the message names the argument and its value."""


class Refused(DomainError):
    """What is wrong with a value, and what would be right."""

    def __init__(self, problem: str, remedy: str) -> None:
        super().__init__(problem, remedy)
        self.problem, self.remedy = problem, remedy

    def __str__(self) -> str:
        return f"{self.problem}; {self.remedy}"


class ConvergenceError(RuntimeError):
    """An iteration or an integration hit its cap; the message says which and where."""


class Cancelled(Exception):
    """A computation was stopped through its monitor."""


@dataclass(frozen=True, slots=True)
class Mistake:
    """One thing wrong with a scene: where, what, and what would be right."""

    where: str  # file, with the line where it is known
    key: str  # dotted; empty where the file as a whole is meant
    value: str  # as it was given, shortened; empty where there is none
    problem: str
    remedy: str

    def __str__(self) -> str:
        subject = self.key + (f" = {self.value}" if self.value else "")
        return ": ".join(part for part in (self.where, subject, self.problem) if part) + f"; {self.remedy}"


class SceneError(ValueError):
    """A scene that cannot be used. `mistakes` lists everything that was found wrong with it."""

    def __init__(self, *mistakes: Mistake) -> None:
        self.mistakes = mistakes
        super().__init__("\n".join(str(mistake) for mistake in mistakes))
