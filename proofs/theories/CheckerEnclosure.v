(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The ninth part of the checker of certificates: intervals that hold real numbers, their ends in units of 1 / u,
   rounded outward. None: no bound is known. CheckerEnclosureSound.v says what follows.
   Roots and pi are hints of any origin. *)
From Coq Require Import ZArith List Bool.
From Dyadel Require Import Checker.
Import ListNotations.
Open Scope Z_scope.

Definition interval : Type := option (Z * Z).

(* a / b rounded up. *)
Definition ceil (a b : Z) : Z := - ((- a) / b).

Section Arithmetic.

(* Ends beyond this are not kept; hints of the k-th root of an integer, of pi u. *)
Variable most : Z.
Variable root_hint : Z -> Z -> Z.
Variable pi_hint : Z -> Z.

Definition whole (u n : Z) : interval := Some (n * u, n * u).
Definition fraction (u n d : Z) : interval := if 0 <? d then Some (n * u / d, ceil (n * u) d) else None.

Definition sign_of (x : interval) : Z :=
  match x with Some (a, b) => if 0 <? a then 1 else if b <? 0 then -1 else 0 | None => 0 end.

Definition add (x y : interval) : interval :=
  match x, y with Some (a, b), Some (c, d) => Some (a + c, b + d) | _, _ => None end.
Definition neg (x : interval) : interval := match x with Some (a, b) => Some (- b, - a) | None => None end.
Definition sub (x y : interval) : interval := add x (neg y).

Definition kept_small (x : interval) : interval :=
  match x with Some (a, b) => if (Z.abs a <? most) && (Z.abs b <? most) then x else None | None => None end.

Definition mul (u : Z) (x y : interval) : interval :=
  match x, y with
  | Some (a, b), Some (c, d) =>
    let p := a * c in let q := a * d in let r := b * c in let s := b * d in
    kept_small (Some (Z.min (Z.min p q) (Z.min r s) / u, ceil (Z.max (Z.max p q) (Z.max r s)) u))
  | _, _ => None
  end.

Definition over (d : Z) (x : interval) : interval := match x with Some (a, b) => Some (a / d,
  ceil b d) | None => None end.
Definition finer (m : Z) (x : interval) : interval := match x with Some (a, b) => Some (a * m,
  b * m) | None => None end.

Definition inverse_positive (u : Z) (x : interval) : interval :=
  match x with Some (a, b) => if 0 <? a then Some (u * u / b, ceil (u * u) a) else None | None => None end.
Definition inverse (u : Z) (x : interval) : interval :=
  if sign_of x =? 1 then inverse_positive u x else neg (inverse_positive u (neg x)).
Definition quotient (u : Z) (x y : interval) : interval := mul u x (inverse u y).

Fixpoint power (u : Z) (x : interval) (n : positive) : interval :=
  match n with
  | xH => x
  | xO k => let y := power u x k in mul u y y
  | xI k => let y := power u x k in mul u x (mul u y y)
  end.
Definition power_Z (u : Z) (x : interval) (n : Z) : interval :=
  match n with Z0 => whole u 1 | Zpos k => power u x k | Zneg k => inverse u (power u x k) end.

Definition absolute (x : interval) : interval :=
  match x with
  | Some (a, b) => if 0 <=? a then x else if b <=? 0 then neg x else Some (0, Z.max (- a) b)
  | None => None
  end.
Definition least (x y : interval) : interval :=
  match x, y with Some (a, b), Some (c, d) => Some (Z.min a c, Z.min b d) | _, _ => None end.
Definition greatest (x y : interval) : interval := neg (least (neg x) (neg y)).

(* All numbers between one of x and one of y. *)
Definition join (x y : interval) : interval :=
  match x, y with Some (a, _), Some (_, b) => Some (a, b) | _, _ => None end.

(* ---- roots ---- *)

Definition cube (z : Z) : Z := z * z * z.

(* For a number of at least 0. *)
Definition square_root (u : Z) (x : interval) : interval :=
  match x with
  | Some (a, b) =>
    let a := Z.max 0 a in
    let r := root_hint 2 (a * u) in let s := root_hint 2 (b * u) in
    let s := if b * u <=? s * s then s else s + 1 in
    if (0 <=? r) && (r * r <=? a * u) && (0 <=? s) && (b * u <=? s * s) then Some (r, s) else None
  | None => None
  end.

Definition cube_root (u : Z) (x : interval) : interval :=
  match x with
  | Some (a, b) =>
    let r := root_hint 3 (a * u * u) in let s := root_hint 3 (b * u * u) in
    let s := if b * u * u <=? cube s then s else s + 1 in
    if (cube r <=? a * u * u) && (b * u * u <=? cube s) then Some (r, s) else None
  | None => None
  end.

(* ---- cosine, pi ---- *)

Definition fuel : nat := 32 * 32.
Definition more_bits : Z := 18446744073709551616. (* 2^64 *)

(* How often z has to be halved to be at most a 2^8th of u. *)
Fixpoint halvings (n : nat) (z u : Z) : nat :=
  match n with O => O | S m => if z * 256 <=? u then O else S (halvings m (z / 2) u) end.
(* How many pairs of terms, each at most a 2^16th of that before. *)
Fixpoint pairs_of_terms (n : nat) (u : Z) : nat :=
  match n with O => O | S m => if u <=? 1 then O else S (pairs_of_terms m (u / 4294967296)) end.

(* t holds a^k / k!, s the sum of k/2 + 1 terms, k/2 even; sq holds a^2. *)
Fixpoint cosine_terms (u : Z) (sq : interval) (n : nat) (k : Z) (t s : interval) : interval :=
  let t1 := over ((k + 1) * (k + 2)) (mul u t sq) in let s1 := sub s t1 in
  let t2 := over ((k + 3) * (k + 4)) (mul u t1 sq) in let s2 := add s1 t2 in
  match n with
  | O => join s1 s2
  | S m => cosine_terms u sq m (k + 4) t2 s2
  end.

Definition small_cosine (u : Z) (x : interval) : interval :=
  match x with
  | Some (a, b) =>
    if (- (2 * u) <=? a) && (b <=? 2 * u)
    then cosine_terms u (mul u x x) (pairs_of_terms fuel u) 0 (whole u 1) (whole u 1) else None
  | None => None
  end.

Fixpoint doubled_cosine (u : Z) (h : nat) (c : interval) : interval :=
  match h with O => c | S m => let q := mul u c c in doubled_cosine u m (sub (add q q) (whole u 1)) end.

Fixpoint two_to (h : nat) : Z := match h with O => 1 | S m => 2 * two_to m end.
Definition extent (x : interval) : Z := match x with Some (a, b) => Z.max (Z.abs a) (Z.abs b) | None => 0 end.

(* For a number between -1 and 1. *)
Definition within_one (u : Z) (x : interval) : interval :=
  match x with Some (a, b) => Some (Z.max (- u) a, Z.min u b) | None => None end.

Definition cosine (u : Z) (x : interval) : interval :=
  let h := halvings 40 (extent x) u in
  let m := two_to h * two_to h * more_bits in
  within_one u (over m (doubled_cosine (u * m) h (small_cosine (u * m) (over (two_to h) (finer m x))))).

Definition half_more : Z := 4294967296.

(* cos sinks through 0 at pi / 2. *)
Definition pi_at (u : Z) : interval :=
  let l := pi_hint u in let v := 2 * u * half_more in
  let at_ := fun z => sign_of (cosine v (whole half_more z)) in
  if (0 <? l) && (l <? 4 * u) && (at_ l =? 1) && (at_ (l + 1) =? -1) then Some (l, l + 1) else None.

(* pi2 holds pi / 2. *)
Definition sine (u : Z) (pi2 x : interval) : interval := cosine u (sub pi2 x).

(* ---- exponentials ---- *)

(* t holds y^k / k!, s the sum of k + 1 terms with alternating signs, k even. *)
Fixpoint exp_terms (u y : Z) (n : nat) (k : Z) (t s : interval) : interval :=
  let t1 := over (k + 1) (mul u t (Some (y, y))) in let s1 := sub s t1 in
  match n with
  | O => join s1 s
  | S m => let t2 := over (k + 2) (mul u t1 (Some (y, y))) in exp_terms u y m (k + 2) t2 (add s1 t2)
  end.

(* exp (y / u), -1 <= y / u <= 1. *)
Definition small_exp (u y : Z) : interval :=
  if Z.abs y <=? u then
    let e := exp_terms u (Z.abs y) (pairs_of_terms fuel (u * u)) 0 (whole u 1) (whole u 1) in
    if 0 <? y then inverse u e else e
  else None.

Fixpoint squared (u : Z) (h : nat) (e : interval) : interval :=
  match h with O => e | S m => squared u m (mul u e e) end.

Definition exponential (u : Z) (x : interval) : interval :=
  let h := halvings 24 (extent x) u in
  let m := two_to h * two_to h * more_bits in let v := u * m in
  match over (two_to h) (finer m x) with
  | Some (a, b) => over m (squared v h (join (small_exp v a) (small_exp v b)))
  | None => None
  end.

(* ---- roots of polynomials, lowest coefficient first ---- *)

(* A power of d, and with it the value at n / d. *)
Fixpoint homogeneous (f : list Z) (n d : Z) : Z * Z :=
  match f with
  | [] => (0, 1)
  | c :: g => let (v, w) := homogeneous g n d in (c * w + n * v, w * d)
  end.
Definition sign_at (f : list Z) (n d : Z) : Z := Z.sgn (fst (homogeneous f n d)).

Fixpoint derivative_from (k : Z) (f : list Z) : list Z := match f with [] => [] | c :: g => k * c :: derivative_from
  (k + 1) g end.
Definition derivative (f : list Z) : list Z := match f with [] => [] | _ :: g => derivative_from 1 g end.

Fixpoint horner (u : Z) (f : list Z) (x : interval) : interval :=
  match f with [] => whole u 0 | c :: g => add (whole u c) (mul u x (horner u g x)) end.

(* The zero of f between lo and hi, each a fraction of two integers. *)
Record bracket : Type := Bracket { coefficients : list Z; lo_num : Z; lo_den : Z; hi_num : Z; hi_den : Z }.

Definition is_single (u : Z) (r : bracket) : bool :=
  let f := coefficients r in
  (0 <? lo_den r) && (0 <? hi_den r) && (lo_num r * hi_den r <? hi_num r * lo_den r) &&
  (sign_at f (lo_num r) (lo_den r) * sign_at f (hi_num r) (hi_den r) =? -1) &&
  negb (sign_of (horner u (derivative f) (join (fraction u (lo_num r) (lo_den r)) (fraction u (hi_num r) (hi_den
    r)))) =? 0).

(* l: a hint of the zero times u, rounded down. *)
Definition enclose_root (u : Z) (r : bracket) (l : Z) : interval :=
  let f := coefficients r in
  if (lo_num r * u <=? l * lo_den r) && ((l + 1) * hi_den r <=? hi_num r * u) && (sign_at f l u * sign_at f (l + 1)
    u <=? 0)
  then Some (l, l + 1) else None.

End Arithmetic.
