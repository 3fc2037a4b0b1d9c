(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The checker as a program: numbers are the binary integers of Coq, so nothing but the extraction is trusted. *)
From Coq Require Import ZArith List Extraction ExtrOcamlBasic.
From Dyadel Require Import Checker.
Extraction "checker.ml" check Z.add Z.mul Z.opp Z.lcm Z.min Z.max Z.shiftl.
