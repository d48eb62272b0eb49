// SPDX-License-Identifier: GPL-3.0-or-later
// Windows cannot become another program. It is started with the same arguments, streams and console, and waited for.
#include "motion_program.h"

#include <windows.h>

#include <filesystem>
#include <string>

#include "option_values.h"
#include "this_process.h"

namespace cli {

void becomeMotion(const char* const* argv)
{
    const std::filesystem::path program = (programFile().parent_path() / DROPLET_MOTION ".exe").lexically_normal();
    // It ends with this process.
    const HANDLE job = ::CreateJobObjectW(nullptr, nullptr);
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
    ::SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof limits);
    STARTUPINFOW startup{};
    ::GetStartupInfoW(&startup);
    PROCESS_INFORMATION process{};
    std::wstring line = ::GetCommandLineW();
    if (::CreateProcessW(program.c_str(), line.data(), nullptr, nullptr, TRUE, CREATE_SUSPENDED, nullptr, nullptr,
                         &startup, &process) == FALSE) {
        refuse(std::string(argv[1]) + " needs the program " + program.string() + ", which is missing");
    }
    ::AssignProcessToJobObject(job, process.hProcess);
    ::ResumeThread(process.hThread);
    // ^C reaches both; that program decides when to end.
    ::SetConsoleCtrlHandler([](DWORD) -> BOOL { return TRUE; }, TRUE);
    ::WaitForSingleObject(process.hProcess, INFINITE);
    DWORD code = 1;
    ::GetExitCodeProcess(process.hProcess, &code);
    ::ExitProcess(code);
}

}  // namespace cli
