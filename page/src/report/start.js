// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Unpacks the report's own script and starts it. The policy of the page knows this text by its hash.
(async () => {
  const text = document.getElementById("tenon-script").textContent;
  const bytes = Uint8Array.from(atob(text.trim()), (c) => c.charCodeAt(0));
  const script = document.createElement("script");
  const plain = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  script.text = await new Response(plain).text();
  document.head.append(script);
})().catch((fault) => {
  const note = document.createElement("p");
  note.setAttribute("role", "alert");
  note.textContent = `This browser cannot show the report: ${fault.message}`;
  document.body.prepend(note);
});
