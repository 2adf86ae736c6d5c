#pragma once

#include <atomic>
#include <string>

namespace dim {

/// Set by Ctrl-C (SIGINT) or SIGTERM; what a long computation looks at.
std::atomic<bool>& stop_flag();

/// Answers SIGINT and SIGTERM: the first sets the stop flag; a program that has not ended by itself a second
/// later, and one that is told twice, ends at once with status 130. Temporaries of the outputs named below
/// are removed first. A reader that went away and a limit on file sizes become errors of write().
void answer_interruptions(const std::string& program);

/// An output that may be half written when the program is ended.
void note_output(const std::string& path);

/// The result is complete: an interruption from now on does not say that nothing was written.
void note_written();

}  // namespace dim
