(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* A further part of the checker of certificates: intervals of logarithms and inverse circular functions. From any y
   near the value the rest is small, and made of functions that are known; so no hint is needed.
   CheckerInverseSound.v says what follows. *)
From Coq Require Import ZArith Bool.
From Dyadel Require Import CheckerEnclosure.
Open Scope Z_scope.

Inductive inverse_function : Type := Logarithm | Arcsine | Arccosine | Arctangent.

(* Finer than the unit. *)
Definition guard : Z := 4294967296.
(* At each round the number of digits is trebled. *)
Definition rounds : nat := 16.

Section Inverse.

Variable most : Z.
Variable root_hint : Z -> Z -> Z.

Definition point (y : Z) : interval := Some (y, y).

Definition is_narrower (a b : Z) (x : interval) : bool := match x with Some (c, d) => b - a <? d - c | None => true end.

(* f at better and better places y, while it gives more than x. *)
Fixpoint settled (n : nat) (f : Z -> interval) (y : Z) (x : interval) : interval :=
  match n, f y with
  | S m, Some (a, b) => if is_narrower a b x then settled m f ((a + b) / 2) (Some (a, b)) else x
  | _, _ => x
  end.

(* By how much the unit has to be finer, so that what x is multiplied with is known well enough. *)
Definition finer_by (u : Z) (x : interval) : Z := Z.max 1 (extent x / u) * guard.

(* log x = y + log e for e = x exp (-y), and 1 - 1 / e <= log e <= e - 1. *)
Definition logarithm_from (u : Z) (x : interval) (y : Z) : interval :=
  let e := mul most u x (exponential most u (point (- y))) in
  if sign_of e =? 1
  then add (point y) (join (sub (whole u 1) (inverse u e)) (sub e (whole u 1))) else None.

(* log 2 is about 45426 / 65536. *)
Definition logarithm (u : Z) (x : interval) : interval :=
  let m := finer_by u x in
  let near := (Z.log2 (extent x) - Z.log2 u) * 45426 * (u * m) / 65536 in
  over m (settled rounds (logarithm_from (u * m) (finer m x)) near None).

Definition around (x : interval) : interval := match x with Some (_, b) => Some (- b, b) | None => None end.

(* atan x = y + atan r for r = (x cos y - sin y) / (cos y + x sin y), and |atan r - r| <= r^2. *)
Definition arctangent_from (u : Z) (pi2 x : interval) (y : Z) : interval :=
  let c := cosine most u (point y) in let s := sine most u pi2 (point y) in
  let d := add c (mul most u x s) in
  let r := quotient most u (sub (mul most u x c) s) d in
  if (Z.abs y <=? 2 * u) && (sign_of d =? 1) then add (point y) (add r (around (mul most u r r))) else None.

Definition arctangent (u : Z) (pi2 x : interval) : interval :=
  let m := finer_by u x in let one := whole u 1 in
  let near := sign_of (sub x one) + sign_of (add x one) in
  over m (settled rounds (arctangent_from (u * m) (finer m pi2) (finer m x)) (Z.quot near 2 * (u * m)) None).

(* asin x = 2 atan (x / (1 + sqrt (1 - x^2))), at -1 and 1 as well. *)
Definition arcsine (u : Z) (pi2 x : interval) : interval :=
  let one := whole u 1 in
  let c := square_root root_hint u (sub one (mul most u x x)) in
  let y := arctangent u pi2 (quotient most u x (add one c)) in add y y.

Definition inverse_value (u : Z) (pi2 : interval) (f : inverse_function) (x : interval) : interval :=
  match f with
  | Logarithm => logarithm u x
  | Arcsine => arcsine u pi2 x
  | Arccosine => sub pi2 (arcsine u pi2 x)
  | Arctangent => arctangent u pi2 x
  end.

End Inverse.
