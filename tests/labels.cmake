# SPDX-License-Identifier: GPL-3.0-or-later
# ctest reads this when it has found the tests of a program: gives `tests` their `labels`, for which gtest_discover_tests
# takes but one. `slow` are series of meshes whose numbers take ten seconds and more under sanitizers, and which enter no
# code that smaller tests do not; there they run with scripts/test --all.
string(JOIN "|" slow
  ConstrainedSolver.Solves
  Exact.NamesTheDroplet Exact.NearlyAHemisphere Exact.NewtonSteps Exact.RefusesMoreThan Exact.SteepCaps
  Grading.MeshesAreValid Grading.NumberOfTriangles
  Hanging.FallsBeyond
  LatticeCore.EveryEdge
  Multigrid.WhatDoesNotConverge
  Penetration.ExactFilm Penetration.KktHold Penetration.SolversAgree
  Solvers.AgreeOnTheZoo)
foreach(test IN LISTS tests)
  if(test MATCHES "^(${slow})")
    set_tests_properties(${test} PROPERTIES LABELS "${labels};slow")
  else()
    set_tests_properties(${test} PROPERTIES LABELS "${labels}")
  endif()
endforeach()
