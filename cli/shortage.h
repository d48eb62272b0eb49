// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>

namespace cli {

/// Lets the process end with one line and exit code 1 where a library gives up because memory or threads are short.
///
/// Most shortages are exceptions, which main() reports. Some are not: TBB cannot start a worker and terminates, GMP
/// aborts, a C library uses a null pointer, the stack cannot grow. Then temporary files are removed and outputs stay as
/// they were. Faults without a shortage end the process as before.
void reportShortages();

/// Whether an exception says that no thread could be started: one of the standard library or of TBB.
bool isThreadShortage(const std::exception& error);

}  // namespace cli
