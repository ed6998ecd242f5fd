// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What all parts of the live page hold together: the connection, the panel, and where to complain.
import type { Panel } from "../panel/panel";
import type { Connection } from "./connection";
import type { Messages } from "./messages";

export interface Session {
  connection: Connection;
  panel: Panel;
  messages: Messages;
}

/** Asks, and complains where it is refused; then there is no result. */
export async function attempt<T>(
  session: Session,
  name: string,
  fields: Record<string, unknown> = {},
): Promise<T | null> {
  try {
    return await session.connection.ask<T>(name, fields);
  } catch (fault) {
    session.messages.complain(fault);
    return null;
  }
}
