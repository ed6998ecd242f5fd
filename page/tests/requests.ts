// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What does not compile: requests, fields and notices that the tables of the program do not have.
import { review } from "../src/live/review";
import { type Session, attempt } from "../src/live/session";
import { Task } from "../src/live/task";

export async function refused(session: Session): Promise<void> {
  // @ts-expect-error: there is no such request
  await attempt(session, "fly");
  // @ts-expect-error: the joint is missing
  await attempt(session, "setDrive");
  // @ts-expect-error: there is no such field
  await attempt(session, "setDrive", { joint: "/a", target: 1 });
  // @ts-expect-error: likewise
  await attempt(session, "play", { count: 1 });
  // @ts-expect-error: likewise
  await new Task(session, "pairs").run({ posture: 1 });
  // @ts-expect-error: it writes nothing
  await review(session, "play", {});
  const answer = await attempt(session, "setDrive", { joint: "/a", position: 1 });
  // @ts-expect-error: the answer has no such field
  answer?.effort;
  // @ts-expect-error: the notice has no such field
  session.connection.on("scene", ({ links }) => links);
  // @ts-expect-error: there is no such notice
  session.connection.on("scenes", () => 0);
}
