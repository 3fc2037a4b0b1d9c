(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The tenth part of the checker of certificates: quotients of polynomials with integer coefficients in leaves x0, x1,
   ..., reduced by the known relations of powers of leaves. CheckerAlgebraSound.v says what follows. *)
From Coq Require Import ZArith NArith List Bool.
From Dyadel Require Import CheckerEnclosure.
Import ListNotations.
Open Scope Z_scope.

(* Exponents of x0, x1, ..., the last one not 0; a product of leaves. *)
Definition monomial : Type := list N.
(* Terms descend, exponents of later leaves being compared first; no coefficient is 0. *)
Definition poly : Type := list (Z * monomial).

Fixpoint compare_monomials (a b : monomial) : comparison :=
  match a, b with
  | [], [] => Eq
  | [], _ => Lt
  | _, [] => Gt
  | d :: a', e :: b' => match compare_monomials a' b' with Eq => (d ?= e)%N | c => c end
  end.

Fixpoint product (a b : monomial) : monomial :=
  match a, b with [], _ => b | _, [] => a | d :: a', e :: b' => (d + e)%N :: product a' b' end.

Fixpoint plus (p : poly) : poly -> poly :=
  match p with
  | [] => fun q => q
  | (c, m) :: p' =>
    fix with_q (q : poly) : poly :=
      match q with
      | [] => p
      | (d, n) :: q' =>
        match compare_monomials m n with
        | Gt => (c, m) :: plus p' q
        | Lt => (d, n) :: with_q q'
        | Eq => if c + d =? 0 then plus p' q' else (c + d, m) :: plus p' q'
        end
      end
  end.

Definition scaled_by (t : Z * monomial) (q : poly) : poly := map (fun s => (fst t * fst s,
  product (snd t) (snd s))) q.
Fixpoint times (p q : poly) : poly := match p with [] => [] | t :: p' => plus (scaled_by t q) (times p' q) end.
Definition constant (z : Z) : poly := if z =? 0 then [] else [(z, [])].
Definition minus (p : poly) : poly := map (fun t => (- fst t, snd t)) p.
(* The k-th leaf. *)
Definition variable (k : nat) : poly := [(1, repeat 0%N k ++ [1%N])].

(* ---- relations ---- *)

(* x^degree is a polynomial in lower powers of x and in leaves before. *)
Record relation : Type := Relation { degree : N; rest : poly }.

Definition exponent (k : nat) (m : monomial) : N := nth k m 0%N.

Definition trimmed (e : N) (m : monomial) : monomial := match m with [] => if (e =? 0)%N then [] else [e] | _ => e
  :: m end.
Fixpoint lowered (k : nat) (d : N) (m : monomial) : monomial :=
  match m, k with
  | [], _ => []
  | e :: m', O => trimmed (e - d) m'
  | e :: m', S j => trimmed e (lowered j d m')
  end.

Definition highest (k : nat) (p : poly) : N := fold_left (fun e t => N.max e (exponent k (snd t))) p 0%N.

(* All terms with the highest power of leaf k, until it is below the degree. *)
Fixpoint reduced_by (fuel : nat) (k : nat) (r : relation) (p : poly) : poly :=
  match fuel with
  | O => p
  | S n =>
    let e := highest k p in
    if (e <? degree r)%N || (degree r =? 0)%N then p else
      let (high, low) := partition (fun t => (exponent k (snd t) =? e)%N) p in
      if forallb (fun t => (degree r <=? exponent k (snd t))%N) high
      then reduced_by n k r (plus low (times (map (fun t => (fst t,
        lowered k (degree r) (snd t))) high) (rest r))) else p
  end.

Definition reductions : nat := 64 * 64 * 4.

(* By the relations of leaves k, k + 1, ..., the last first. *)
Fixpoint reduced (k : nat) (l : list (option relation)) (p : poly) : poly :=
  match l with
  | [] => p
  | r :: l' => let q := reduced (S k) l' p in match r with Some s => reduced_by reductions k s q | None => q end
  end.

(* ---- quotients ---- *)

Definition quotient_of : Type := option (poly * poly).

Section Quotients.

(* Coefficients beyond this are not kept. *)
Variable most : Z.
Variable leaves : list (option relation).

Definition most_terms : nat := 64 * 64.
Definition is_small (p : poly) : bool := (Nat.leb (length p) most_terms) && forallb (fun t => Z.abs (fst t) <? most)
  p.

Definition content (p : poly) (g : Z) : Z := fold_left (fun h t => if h =? 1 then 1 else Z.gcd h (fst t)) p g.
Definition divided (g : Z) (p : poly) : poly := map (fun t => (fst t / g, snd t)) p.

(* In lowest terms, as far as integers go. *)
Definition shortened (p q : poly) : quotient_of :=
  if is_small p && is_small q then
    let g := content p (content q 0) in
    if (1 <? g) && forallb (fun t => fst t mod g =? 0) p && forallb (fun t => fst t mod g =? 0) q
    then Some (divided g p, divided g q) else Some (p, q)
  else None.

Definition product_of (p q : poly) : poly := reduced 0 leaves (times p q).
(* The product with fewer steps first. *)
Definition is_light (p q : poly) : bool := Nat.leb (length p + length q) most_terms.

Definition q_integer (n : Z) : quotient_of := Some (constant n, constant 1).
Definition q_fraction (n d : Z) : quotient_of := if d =? 0 then None else shortened (constant n) (constant d).
Definition q_neg (x : quotient_of) : quotient_of := match x with Some (p, q) => Some (minus p, q) | None => None end.

Fixpoint same_monomial (a b : monomial) : bool :=
  match a, b with [], [] => true | d :: a', e :: b' => (d =? e)%N && same_monomial a' b' | _, _ => false end.
Fixpoint same_poly (p q : poly) : bool :=
  match p, q with
  | [], [] => true
  | (c, m) :: p', (d, n) :: q' => (c =? d) && same_monomial m n && same_poly p' q'
  | _, _ => false
  end.

Definition q_add (x y : quotient_of) : quotient_of :=
  match x, y with
  | Some (p, q), Some (r, s) =>
    if same_poly q s then shortened (plus p r) q
    else if is_light p s && is_light q r && is_light q s
    then shortened (plus (product_of p s) (product_of r q)) (product_of q s) else None
  | _, _ => None
  end.
Definition q_sub (x y : quotient_of) : quotient_of := q_add x (q_neg y).
Definition q_mul (x y : quotient_of) : quotient_of :=
  match x, y with
  | Some (p, q), Some (r, s) =>
    if is_light p r && is_light q s then shortened (product_of p r) (product_of q s) else None
  | _, _ => None
  end.
(* Of a number that is not 0. *)
Definition q_inverse (x : quotient_of) : quotient_of := match x with Some (p, q) => Some (q, p) | None => None end.

Fixpoint q_power (x : quotient_of) (n : positive) : quotient_of :=
  match n with
  | xH => x
  | xO k => let y := q_power x k in q_mul y y
  | xI k => let y := q_power x k in q_mul x (q_mul y y)
  end.
Definition q_power_Z (x : quotient_of) (n : Z) : quotient_of :=
  match n with Z0 => q_integer 1 | Zpos k => q_power x k | Zneg k => q_power (q_inverse x) k end.

Definition is_null (x : quotient_of) : bool := match x with Some ([], _) => true | _ => false end.
Definition are_equal (x y : quotient_of) : bool := is_null (q_sub x y).

(* Horner's rule. *)
Fixpoint q_horner (f : list Z) (x : quotient_of) : quotient_of :=
  match f with [] => q_integer 0 | c :: g => q_add (q_integer c) (q_mul x (q_horner g x)) end.

End Quotients.

(* ---- enclosures ---- *)

Section Enclosures.

Variable most u : Z.
Variable held : list interval.

Fixpoint enclose_monomial (m : monomial) (l : list interval) : interval :=
  match m with
  | [] => whole u 1
  | e :: m' =>
    match l with
    | [] => None
    | x :: l' =>
      let y := enclose_monomial m' l' in
      match e with N0 => y | Npos n => mul most u (power most u x n) y end
    end
  end.
Definition enclose_poly (p : poly) : interval :=
  fold_right (fun t x => add (mul most u (whole u (fst t)) (enclose_monomial (snd t) held)) x) (whole u 0) p.

End Enclosures.
