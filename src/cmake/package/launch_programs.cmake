# SPDX-License-Identifier: GPL-3.0-or-later
# Puts the starting program in the place of each program of the archive, which it starts as NAME.elf.
foreach(program ${CPACK_DROPLET_LAUNCHED})
  file(GLOB_RECURSE found ${CPACK_TEMPORARY_DIRECTORY}/*)
  list(FILTER found INCLUDE REGEX "/${program}$")
  foreach(path ${found})
    file(RENAME ${path} ${path}.elf)
    file(COPY_FILE ${CPACK_DROPLET_LAUNCH} ${path})
    execute_process(COMMAND strip ${path} COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
endforeach()
