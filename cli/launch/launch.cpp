// SPDX-License-Identifier: GPL-3.0-or-later
//
// Starts a program of the archive with the C library and the loader that the archive brings, on any distribution of
// Linux. It takes the place of the program NAME, which is beside it as NAME.elf, and needs no library itself. The
// loader is in the folder of libraries, in a folder above this program.
//
// Linux manual: ld.so(8) on --library-path and --argv0, getauxval(3) on AT_EXECFN.
#include <sys/auxv.h>
#include <unistd.h>

#include <climits>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

/// This program's path, with links followed.
std::string ownPath()
{
    std::vector<char> path(PATH_MAX);
    if (const ssize_t length = ::readlink("/proc/self/exe", path.data(), path.size()); length > 0) {
        return {path.data(), static_cast<std::size_t>(length)};
    }
    // Without /proc the kernel has the path as it was given.
    // NOLINTNEXTLINE(performance-no-int-to-ptr): the kernel gives addresses as numbers
    const auto* const given = reinterpret_cast<const char*>(::getauxval(AT_EXECFN));
    return given != nullptr && ::realpath(given, path.data()) != nullptr ? path.data() : "";
}

}  // namespace

int main(int argc, char** argv)
{
    const std::string self = ownPath();
    for (std::size_t slash = self.rfind('/'); slash != std::string::npos;
         slash = slash == 0 ? std::string::npos : self.rfind('/', slash - 1)) {
        const std::string libraries = self.substr(0, slash) + "/" DROPLET_LIBRARIES;
        const std::string loader = libraries + "/" DROPLET_LOADER;
        if (::access(loader.c_str(), X_OK) != 0) {
            continue;
        }
        const std::string program = self + ".elf";
        std::vector<const char*> words{
            loader.c_str(), "--library-path", libraries.c_str(), "--argv0", argc > 0 ? argv[0] : self.c_str(),
            program.c_str()};
        words.insert(words.end(), argv + (argc > 0 ? 1 : 0), argv + argc);
        words.push_back(nullptr);
        ::execv(loader.c_str(), const_cast<char* const*>(words.data()));
        break;
    }
    std::fprintf(stderr, "%s: the libraries of its archive are missing\n", self.c_str());
    return 127;
}
