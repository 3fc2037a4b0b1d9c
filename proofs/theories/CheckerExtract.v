(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The checker as a program. Integers are those of Zarith, which is built on GMP: it and the extraction are trusted. *)
From Coq Require Import ZArith List Extraction ExtrOcamlBasic ExtrOcamlZBigInt.
From Dyadel Require Import Checker CheckerFaces CheckerBounds CheckerCover CheckerChain CheckerTies CheckerDiagram CheckerDistance.
From Dyadel Require Import CheckerStill CheckerEnclosure CheckerInverse CheckerAlgebra CheckerBlock CheckerVanish CheckerFacts.
From Dyadel Require Import CheckerTied.
Extract Constant Z.ltb => "Big_int_Z.lt_big_int".
Extract Constant Z.leb => "Big_int_Z.le_big_int".
Extraction "checker.ml" check check_edge surrounded all_surrounded sure_triangles sure_corners all_covered broken_chains
  area_holds hausdorff_holds loose_ties bound_reaches is_fixpoint polygons_hold undetermined_holds distance_holds index build deepest
  scaled_sites turn run nothing place_in place_outside fact_holds fact_fails loose_of_sets pi_at sign_at compare_monomials.
