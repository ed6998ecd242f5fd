# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A row of the tables: one option of a verb, how it is given, and what has to come of it."""

import dataclasses
import re
from typing import Any, Callable, Optional



@dataclasses.dataclass
class Outcome:
    """What a run of the program left behind."""

    code: int
    text: str = ""  # standard output
    said: str = ""  # standard error
    answer: Optional[dict] = None  # of --json
    files: dict = dataclasses.field(default_factory=dict)  # name -> bytes
    browser: list = dataclasses.field(default_factory=list)  # arguments of the one that drew
    seen: Any = None  # what any option may change: motion, gaps, what is drawn

    def findings(self):
        """All that was told, as one text."""
        told = self.answer["diagnostics"] if self.answer else []
        lines = [f"[{d['rule']}] {d['message']}; {d['fix']} <{d['prim']}> {d['file']}"
                 for d in told]
        return "\n".join([self.said, *lines])


@dataclasses.dataclass
class Row:
    """`words` are given beside what the verb's runs are given anyhow; `with_` to both runs, the one
    with the option and the one without; of an option that both have, the later words count.

    The option acts where `sees` of the two differ, or, where there is `wanted`, where it is true of
    (without, with, engine). `refused` says which engines refuse it, in which words. `same` names
    the engines for which the option says what they do anyhow, so that nothing may change.
    """

    option: str
    words: tuple
    with_: tuple = ()
    sees: Callable = lambda outcome: outcome.seen
    wanted: Optional[Callable] = None
    refused: dict = dataclasses.field(default_factory=dict)
    same: tuple = ()
    asset: str = "main.usda"
    leaves_out: tuple = ()  # options that the verb's runs are given anyhow, and these are not
    once: bool = False  # no engine has a part in it: on one engine, in `make test`

    def name(self):
        return " ".join(map(str, self.words)) or self.option

    def fault(self, engine, without, outcome):
        """-> what is wrong, or nothing."""
        refusal = self.refused.get(engine) or self.refused.get("*")
        if refusal:
            if outcome.code == 0:
                return "is not refused"
            if not re.search(refusal, outcome.findings()):
                return f"is refused in other words than /{refusal}/: {outcome.findings()[:400]}"
            return None
        if without.code not in (0, 1):
            return f"without it: exit code {without.code}: {without.findings()[:400]}"
        if outcome.code not in (0, 1) and not self.wanted:
            return f"exit code {outcome.code}: {outcome.findings()[:400]}"
        if self.wanted:
            return None if self.wanted(without, outcome, engine) else "does not act as it should"
        before, after = self.sees(without), self.sees(outcome)
        if engine in self.same:
            return None if before == after else "changes what it should leave as it is"
        return "changes nothing, and nothing is said" if before == after else None
