(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The checker as a program. Numbers are the binary integers of Coq: nothing but the extraction is trusted. *)
From Coq Require Import ZArith List Extraction ExtrOcamlBasic.
From Dyadel Require Import Checker CheckerFaces.
Extraction "checker.ml" check surrounded all_surrounded scaled_sites turn Z.add Z.mul Z.opp Z.lcm Z.min Z.max Z.shiftl Z.ltb.
