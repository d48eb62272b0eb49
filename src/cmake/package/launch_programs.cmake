# SPDX-License-Identifier: GPL-3.0-or-later
# Puts the starting program in the place of each program, which it starts as NAME.elf, in a package that has a loader.
if(has_loader)
  foreach(program ${launched})
    set(path $ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/${program})
    file(RENAME ${path} ${path}.elf)
    file(COPY_FILE ${launch} ${path})
    execute_process(COMMAND ${strip} ${path} COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
endif()
