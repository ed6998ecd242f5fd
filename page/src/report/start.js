// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Unpacks the slots of the report and starts its own script. The policy of the page knows this text
// by its hash. A slot has seven bits in a character, the highest first; 256 higher where HTML would
// read or change it (tenon/bytes/gzip.h).
(() => {
  const bytesOf = (text) => {
    const bytes = new Uint8Array(Math.floor((text.length * 7) / 8));
    let held = 0;
    let count = 0;
    let at = 0;
    for (let i = 0; i < text.length && at < bytes.length; ++i) {
      held = ((held << 7) | (text.charCodeAt(i) & 255)) & 0xffff;
      count += 7;
      if (count >= 8) {
        count -= 8;
        bytes[at++] = (held >> count) & 255;
      }
    }
    return bytes;
  };
  const slot = async (id) => {
    const element = document.getElementById(id);
    const bytes = bytesOf(element.textContent);
    element.remove();
    if (element.dataset.coding !== "gzip") {
      return bytes.buffer;
    }
    const plain = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Response(plain).arrayBuffer();
  };
  window.tenonSlot = slot;
  slot("tenon-script")
    .then((bytes) => {
      const script = document.createElement("script");
      script.text = new TextDecoder().decode(bytes);
      document.head.append(script);
    })
    .catch((fault) => {
      const note = document.createElement("p");
      note.setAttribute("role", "alert");
      note.textContent = `This browser cannot show the report: ${fault.message}`;
      document.body.prepend(note);
    });
})();
