(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The filters as the theories define them, as a program: Flocq's doubles, computed with integers. *)
From Coq Require Import ZArith Extraction ExtrOcamlBasic ExtrOcamlZBigInt.
From Flocq Require Import IEEE754.Binary IEEE754.Bits.
From Dyadel Require Import FiltersBase FiltersOrient FiltersIncircleAt FiltersIncircleNear FiltersSmall FiltersDistance
  FiltersSlack.
Extract Constant Z.ltb => "Big_int_Z.lt_big_int".
Extract Constant Z.leb => "Big_int_Z.le_big_int".
Definition is_nan_double (x : binary64) : bool := is_nan 53 1024 x.
Definition box (a b c d : binary64) : bbox := Build_bbox a b c d.
Extraction "filters.ml" b64_of_bits bits_of_b64 is_nan_double box orient_bound filter_orient filter_orient_near
  filter_incircle_at filter_incircle_near filter_incircle_small filter_orient_small lower upper ds2_lower dl2_upper
  ds2_upper dl2_lower.
