// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What all parts of the live page hold together: the connection, the panel, and where to complain.
import type { Panel } from "../panel/panel";
import type { Answer, BareRequest, Connection, Fields, RequestName } from "./connection";
import type { Messages } from "./messages";

export interface Session {
  connection: Connection;
  panel: Panel;
  messages: Messages;
}

/** Asks, and complains where it is refused; then there is no result. */
export function attempt<Name extends BareRequest>(session: Session, name: Name): Promise<Answer<Name> | null>;
export function attempt<Name extends RequestName>(session: Session, name: Name, fields: Fields<Name>): Promise<Answer<Name> | null>;
export async function attempt<Name extends RequestName>(session: Session, name: Name, fields: Fields<Name> = {}): Promise<Answer<Name> | null> {
  try {
    return await session.connection.ask(name, fields);
  } catch (fault) {
    session.messages.complain(fault);
    return null;
  }
}
