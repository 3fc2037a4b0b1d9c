(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** The constants of the filters: (m, e) is m * 2^e. tests of the suite `proofs` compare each with the C source: the
    comment names the claim, the file, and the place, where {} marks the constant. *)
From Coq Require Import ZArith Reals Lra.
From Flocq Require Import Core.
From Dyadel Require Import FiltersBase FiltersError.

(* [FLT-ORI] src/skeleton/mesh_filter.h: extent_x * extent_y * {} + *)
Definition c_orient_bound : const := (5121308424922047, -102)%Z.
(* [FLT-ORI] src/skeleton/mesh_filter.h: 1.01e-15 + {} * delta * *)
Definition c_orient_delta : const := (10, 0)%Z.
(* [FLT-ORI] src/skeleton/mesh_filter.h: delta * (e + {} * delta) *)
Definition c_orient_delta2 : const := (4, 0)%Z.
(* [FLT-ORI] src/skeleton/mesh_filter.h: * (e + 4 * delta) + {}; *)
Definition c_orient_tiny : const := (1, -1000)%Z.
(* [FLT-ORI] src/skeleton/mesh_filter.c: double e = {} * (fabs(left) + fabs(right)) *)
Definition c_orient_near : const := (2257429313219461, -102)%Z.
(* [FLT-ORI] src/skeleton/mesh_filter.c: (fabs(left) + fabs(right)) + {}; *)
Definition c_orient_near_tiny : const := (1, -1000)%Z.

(* [FLT-INC] src/skeleton/mesh_filter.h: if (m->incircle_delta > {}) { *)
Definition c_zero : const := (0, 0)%Z.

(* [FLT-INC] src/skeleton/mesh_filter.h: #define DYD_INCIRCLE_BOUND {} *)
Definition c_incircle_bound : const := (2281771080410813, -102)%Z.
(* [FLT-INC] src/skeleton/mesh_filter.h: #define DYD_INCIRCLE_TINY {} *)
Definition c_incircle_tiny : const := (1, -790)%Z.
(* [FLT-INC] src/skeleton/mesh_filter.h: double t = sqrt(s) + {} * m->incircle_delta; *)
Definition c_incircle_far : const := (8, 0)%Z.
(* [FLT-INC] src/skeleton/mesh_filter.h: e += {} * m->incircle_delta * t * t * t; *)
Definition c_incircle_delta : const := (60, 0)%Z.
(* [FLT-INC] src/skeleton/mesh_filter.c: e = {} * e + *)
Definition c_incircle_near : const := (3110298492652749, -101)%Z.
(* [FLT-INC] src/skeleton/mesh_filter.c: * e + {} * (la + lb + lc + 1); *)
Definition c_incircle_near_tiny : const := (1, -1060)%Z.
(* [FLT-INC] src/skeleton/mesh_filter.c: * (la + lb + lc + {}); *)
Definition c_one : const := (1, 0)%Z.

(* [FLT-DST] src/skeleton/rects_filter.h: #define DYD_DOWN_FACTOR {} *)
Definition c_down_factor : const := (4503599627370491, -52)%Z.
(* [FLT-DST] src/skeleton/rects_filter.h: #define DYD_UP_FACTOR {} *)
Definition c_up_factor : const := (4503599627370501, -52)%Z.
(* [FLT-DST] src/skeleton/rects_filter.h: #define DYD_TINY {} *)
Definition c_tiny : const := (1, -1000)%Z.
(* [FLT-DST] src/skeleton/rects_filter.h: return y > DBL_MAX / 4 ? {} : y; *)
Definition c_cut : const := (9007199254740991, 969)%Z.
(* [FLT-DST] src/skeleton/rects_filter.h: if (!(dx <= {} && dy *)
Definition c_dbl_max : const := (9007199254740991, 971)%Z.

(** Constants as numerals that lra can read. *)
Ltac numerals :=
  unfold cval; cbn [fst snd bpow];
  repeat match goal with
    | |- context [Z.pow_pos ?b ?p] =>
        let v := eval vm_compute in (Z.pow_pos b p) in change (Z.pow_pos b p) with v
    end.
