// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tenon {

/// For programs that live for one answer; call it first in main(). Freed memory is kept until the
/// end, since returning it to the system and asking for it again costs a page fault per page. The
/// heap grows by 64 MB at once, touched only where used, in pages of 2 MB where the system has
/// them: one page fault instead of 512. Does nothing without glibc.
void keep_heap_in_huge_pages();

/// The same for the heap of a thread that begins; nothing where the program did not ask for it.
void prepare_thread_heap();

}  // namespace tenon
