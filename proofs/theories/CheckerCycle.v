(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The fifteenth part of the checker of certificates: the polynomials of 2 cos (2 pi / N). Leaves.v says what
   follows. *)
From Coq Require Import ZArith List Bool.

(* ---- integer polynomials in one variable, lowest coefficient first ---- *)

Definition poly : Type := list Z.

Fixpoint scale (c : Z) (f : poly) : poly :=
  match f with nil => nil | d :: g => (c * d)%Z :: scale c g end.
Fixpoint plus (f g : poly) : poly :=
  match f, g with nil, _ => g | _, nil => f | c :: f', d :: g' => (c + d)%Z :: plus f' g' end.
Fixpoint times (f g : poly) : poly :=
  match f with nil => nil | c :: f' => plus (scale c g) (0%Z :: times f' g) end.
Fixpoint is_null (f : poly) : bool :=
  match f with nil => true | c :: g => Z.eqb c 0 && is_null g end.

(* ---- 2 cos (2 pi / N) ---- *)

(* C_k, C_k+1: 2 cos (k t) in 2 cos t. *)
Fixpoint chebyshev (k : nat) : poly * poly :=
  match k with
  | O => (2%Z :: nil, 0%Z :: 1%Z :: nil)
  | S j => let (a, b) := chebyshev j in (b, plus (0%Z :: b) (scale (-1) a))
  end.

(* C_k - 2, 0 where k t is a multiple of the full turn. *)
Definition closes (k : nat) : poly := plus (fst (chebyshev k)) ((-2)%Z :: nil).

Definition all_close (l : list nat) : poly := fold_right (fun d f => times (closes d) f) (1%Z :: nil) l.

(* f^2 times what closes earlier is a multiple of what closes at n: then f is 0 at 2 cos (2 pi / n). *)
Definition is_cycle (n : nat) (f : poly) (earlier : list nat) (quotient : poly) : bool :=
  Nat.ltb 0 n && forallb (fun d => Nat.ltb 0 d && Nat.ltb d n) earlier &&
  is_null (plus (times (times f f) (all_close earlier)) (scale (-1) (times (closes n) quotient))).

(* The polynomials of the checker, src/checker/cycle.c, as it computes them. Quotients are guessed by division. *)
Definition proper (n : nat) : list nat := filter (fun d => Nat.eqb (Nat.modulo n d) 0) (seq 1 n).
Definition is_prime (p : nat) : bool := Nat.eqb (length (proper p)) 2.
Definition moebius (n : nat) : Z :=
  fold_right (fun p s => if is_prime p then (if Nat.eqb (Nat.modulo (Nat.div n p) p) 0 then 0 else - s)%Z else s) 1%Z
    (proper n).
Definition totient (n : nat) : nat := length (filter (fun k => Nat.eqb (Nat.gcd k n) 1) (seq 1 n)).
(* c (1 - x^d), c / (1 - x^d), up to the power x^m; back: the d last ones, the latest first. *)
Definition shifted (m d : nat) (c : poly) : poly := firstn (S m) (repeat 0%Z d ++ c).
Fixpoint divided (fuel d : nat) (back c : poly) : poly :=
  match fuel, c with
  | S k, a :: c' => let b := (a + nth (d - 1) back 0)%Z in b :: divided k d (b :: back) c'
  | _, _ => nil
  end.
Definition lower_half (m n : nat) : poly :=
  fold_left (fun c d => match moebius (n / d) with
    | 1%Z => plus c (scale (-1) (shifted m d c))
    | (-1)%Z => divided (S m) d nil c
    | _ => c
    end) (filter (fun d => Nat.leb d m) (proper n)) (1%Z :: repeat 0%Z m).
Definition psi (n : nat) : poly := match n with 1%nat => (-2)%Z :: 1%Z :: nil | 2%nat => 2%Z :: 1%Z :: nil | _ =>
  let m := Nat.div (totient n) 2 in let c := lower_half m n in
  fold_left (fun f j => plus f (scale (nth (m - j) c 0%Z) (fst (chebyshev j)))) (seq 1 m) (nth m c 0%Z :: nil)
  end.
(* Division by a polynomial with leading coefficient 1, highest first. *)
Fixpoint divide (fuel : nat) (f g : poly) : poly :=
  match fuel, f with
  | S k, c :: f' => if Nat.ltb (length f) (length g) then nil
    else c :: divide k (match plus f (scale (- c) g) with nil => nil | _ :: r => r end) g
  | _, _ => nil
  end.
Fixpoint trimmed (f : poly) : poly :=
  match f with nil => nil | c :: g => if Z.eqb c 0 then trimmed g else f end.
Definition cycle_is_psi (n : nat) : bool :=
  let earlier := map (fun p => Nat.div n p) (filter is_prime (proper n)) in
  let f := times (times (psi n) (psi n)) (all_close earlier) in
  is_cycle n (psi n) earlier (rev (divide (length f) (trimmed (rev f)) (trimmed (rev (closes n))))).
