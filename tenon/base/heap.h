// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tenon {

/// For programs that live for one answer; call it first in main(). Memory is kept until the end,
/// since what is given back to the system only to be asked for again costs a page fault for each
/// page, and the heap grows by 64 MB at once, taken only where it is touched, in pages of 2 MB
/// where the system has them to give: one page fault in place of 512. Does nothing without glibc.
void keep_heap_in_huge_pages();

/// The same for the heap of a thread that begins; nothing where the program did not ask for it.
void prepare_thread_heap();

}  // namespace tenon
