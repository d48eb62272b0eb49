# SPDX-License-Identifier: GPL-3.0-or-later
# ctest reads this when it has found the tests of a program: gives `tests` their `labels`, for which gtest_discover_tests
# takes but one. `slow` are those that take a minute and more under sanitizers; there they run with scripts/test --all.
set(slow "^(ConstrainedSolver\\.SolvesOnTheZooAndAgrees)$")
foreach(test IN LISTS tests)
  if(test MATCHES "${slow}")
    set_tests_properties(${test} PROPERTIES LABELS "${labels};slow")
  else()
    set_tests_properties(${test} PROPERTIES LABELS "${labels}")
  endif()
endforeach()
