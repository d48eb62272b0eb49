// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every thread computes as the first one does. MinGW-w64's sines, powers and logarithms use the x87, which Windows
// starts with 53 bits in a new thread; MinGW-w64 sets 64 bits in the first one and in its own, TBB does not in its
// threads. So results would depend on the thread. Windows calls these functions in each new thread.
#include <windows.h>

namespace {

void NTAPI useExtendedPrecision(void* /*module*/, DWORD reason, void* /*reserved*/)
{
    if (reason == DLL_THREAD_ATTACH) {
        const unsigned short control = 0x37F;  // 64 bits, to nearest, no exceptions, as fninit leaves it
        __asm__ volatile("fldcw %0" : : "m"(control));
    }
}

}  // namespace

// The list of such functions: the linker sorts these sections by name.
extern "C" [[gnu::section(".CRT$XLC"), gnu::used]] const PIMAGE_TLS_CALLBACK droplet_thread_start =
    useExtendedPrecision;
