// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Edits of the panels: what they would change in which file is shown first, and written when somebody
// says so. They go the way of every edit, so that Undo takes them back.
import { h } from "../panel/dom";
import type { Answer, Fields, RequestName } from "./connection";
import type { Edited } from "./protocol";
import { type Session, attempt } from "./session";

/** Requests that write. */
type Edit = {
  [Name in RequestName]: Answer<Name> extends Edited ? ("dryRun" extends keyof Fields<Name> ? Name : never) : never;
}[RequestName];

const mostLines = 2000;
const kindOf = (line: string): string =>
  line.startsWith("+") ? "added" : line.startsWith("-") ? "removed" : line.startsWith("@@") ? "place" : "";

function diffOf({ files }: Edited): HTMLElement[] {
  return files.map(({ file, diff }) => {
    if (diff === null) {
      return h("p", {}, `${file} changes; it is no text.`);
    }
    const all = diff.trimEnd().split("\n");
    const lines = all.slice(0, mostLines).map((line) => h("span", { class: kindOf(line) }, `${line}\n`));
    const left = all.length > mostLines ? [`${all.length - mostLines} more lines are not shown.`] : [];
    return h("pre", { class: "diff", role: "region", tabindex: 0, "aria-label": `Difference of ${file}` }, ...lines, ...left);
  });
}

/** Asks whether to write; the request is sent with `dryRun` before. -> whether it was written. */
export async function review<Name extends Edit>(session: Session, request: Name, fields: Fields<Name>): Promise<boolean> {
  const planned = await attempt(session, request, { ...fields, dryRun: true });
  if (!planned) {
    return false;
  }
  const wanted = await new Promise<boolean>((answer) => {
    const dialog: HTMLDialogElement = h(
      "dialog",
      {
        class: "help review",
        "aria-label": "What will be written",
        onclose: () => {
          dialog.remove();
          answer(dialog.returnValue === "write");
        },
        // Keys of the page rest meanwhile.
        onkeydown: (event: KeyboardEvent) => event.stopPropagation(),
      },
      h("h2", {}, "What will be written"),
      ...diffOf(planned),
      h(
        "div",
        { class: "buttons" },
        h("button", { type: "button", onclick: () => dialog.close("write") }, "Write"),
        h("button", { type: "button", autofocus: true, onclick: () => dialog.close("") }, "Do not write"),
      ),
    );
    document.body.append(dialog);
    dialog.showModal();
  });
  const written = wanted && (await attempt(session, request, fields)) !== null;
  if (written) {
    const names = planned.files.map(({ file }) => file.slice(file.lastIndexOf("/") + 1));
    session.messages.say(`Written: ${names.join(", ")}. Undo takes it back.`);
  }
  return written;
}
