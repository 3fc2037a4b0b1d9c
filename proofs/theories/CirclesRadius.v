(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [CRIT-1] The squared radius of a critical circle, its side of a point, and whether its centre is in a slab, as
    src/predicate/circle.c and icircles.c find them: numbers of the form A + B sqrt(C), decided by [SQR-1]. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Dyadel Require Import Surd.
Open Scope R_scope.

(** The centre ((ax + bx sqrt c) / d, (ay + by sqrt c) / d) and the corner (px, py) on the circle. *)
Definition coordinate (a b c d : Z) : R := (IZR a + IZR b * sqrt (IZR c)) / IZR d.

(* C src/predicate/circle.c circle_set_radius
  mpz_t u, v;
  mpz_init_set(u, k->ax);
  mpz_init_set(v, k->ay);
  mpz_submul(u, k->px, k->d);
  mpz_submul(v, k->py, k->d);
  mpz_mul(out->br, u, k->bx);
  mpz_addmul(out->br, v, k->by);
  mpz_mul_2exp(out->br, out->br, 1);
  mpz_mul(out->ar, k->bx, k->bx);
  mpz_addmul(out->ar, k->by, k->by);
  mpz_mul(out->ar, out->ar, k->c);
  mpz_addmul(out->ar, u, u);
  mpz_addmul(out->ar, v, v);
  mpz_mul(out->dr, k->d, k->d);
  mpz_clear(v);
  mpz_clear(u);
*)
Definition radius_a (ax bx ay by_ c d px py : Z) : Z :=
  let u := (ax - px * d)%Z in let v := (ay - py * d)%Z in ((bx * bx + by_ * by_) * c + u * u + v * v)%Z.
Definition radius_b (ax bx ay by_ d px py : Z) : Z :=
  let u := (ax - px * d)%Z in let v := (ay - py * d)%Z in ((u * bx + v * by_) * 2)%Z.

Lemma root2 c : (0 <= c)%Z -> sqrt (IZR c) * sqrt (IZR c) = IZR c.
Proof. intros C; apply sqrt_sqrt; now apply IZR_le. Qed.

Theorem radius_correct ax bx ay by_ c d px py : (0 <= c)%Z -> (0 < d)%Z ->
  let x := coordinate ax bx c d in let y := coordinate ay by_ c d in
  (x - IZR px) * (x - IZR px) + (y - IZR py) * (y - IZR py) =
    coordinate (radius_a ax bx ay by_ c d px py) (radius_b ax bx ay by_ d px py) c (d * d).
Proof.
  intros C D. cbv zeta. unfold coordinate, radius_a, radius_b. cbv zeta. pose proof (root2 c C) as R.
  assert (D' : IZR d <> 0) by (apply IZR_neq; lia). set (r := sqrt (IZR c)) in *.
  repeat rewrite ?mult_IZR, ?plus_IZR, ?minus_IZR. rewrite <- R. field. exact D'.
Qed.

(* C src/predicate/circle.c surd_add_square
  if (!z) return;
  mpz_mul(t, s->b, s->b);
  mpz_addmul(p, t, s->c);
  mpz_set(t, s->a);
  mpz_submul(t, z, s->d);
  mpz_addmul(p, t, t);
  mpz_mul_2exp(t, t, 1);
  mpz_addmul(q, t, s->b);
*)
Definition add_square_p (p a b c d z : Z) : Z := let t := (a - z * d)%Z in (p + b * b * c + t * t)%Z.
Definition add_square_q (q a b d z : Z) : Z := let t := (a - z * d)%Z in (q + t * 2 * b)%Z.

Lemma add_square_correct p q a b c d z : (0 <= c)%Z -> (0 < d)%Z -> let x := coordinate a b c d in
  IZR (add_square_p p a b c d z) + IZR (add_square_q q a b d z) * sqrt (IZR c) =
    IZR p + IZR q * sqrt (IZR c) + IZR d * IZR d * ((x - IZR z) * (x - IZR z)).
Proof.
  intros C D. cbv zeta. unfold coordinate, add_square_p, add_square_q. cbv zeta. pose proof (root2 c C) as R.
  assert (D' : IZR d <> 0) by (apply IZR_neq; lia). set (r := sqrt (IZR c)) in *.
  repeat rewrite ?mult_IZR, ?plus_IZR, ?minus_IZR. rewrite <- R. field. exact D'.
Qed.

(** The sign of the squared distance to (zx, zy) minus the squared radius (ar + br sqrt c) / dr. *)
Definition side (ax bx ay by_ c d ar br dr zx zy : Z) : Z :=
  let p := add_square_p (add_square_p 0 ax bx c d zx) ay by_ c d zy in
  let q := add_square_q (add_square_q 0 ax bx d zx) ay by_ d zy in
  sqrt_sign (p * dr - ar * (d * d)) (q * dr - br * (d * d)) c.

Lemma sgn_scale k x : 0 < k -> sgn (k * x) = sgn x.
Proof.
  intros K. destruct (sgn_cases x) as [[X ->]|[[X ->]|[X ->]]].
  - apply sgn_pos. now apply Rmult_lt_0_compat.
  - apply sgn_neg. assert (0 < k * - x) by (apply Rmult_lt_0_compat; lra). lra.
  - rewrite X, Rmult_0_r. apply sgn_0.
Qed.

Theorem side_correct ax bx ay by_ c d ar br dr zx zy : (0 <= c)%Z -> (0 < d)%Z -> (0 < dr)%Z ->
  let x := coordinate ax bx c d in let y := coordinate ay by_ c d in
  side ax bx ay by_ c d ar br dr zx zy =
    sgn ((x - IZR zx) * (x - IZR zx) + (y - IZR zy) * (y - IZR zy) - coordinate ar br c dr).
Proof.
  intros C D E x y. unfold side. cbv zeta. rewrite sqrt_sign_correct by exact C.
  pose proof (add_square_correct (add_square_p 0 ax bx c d zx) (add_square_q 0 ax bx d zx) ay by_ c d zy C D) as S.
  pose proof (add_square_correct 0 0 ax bx c d zx C D) as T. cbv zeta in S, T. fold y in S. fold x in T.
  rewrite T in S. set (p := add_square_p (add_square_p 0 ax bx c d zx) ay by_ c d zy) in *.
  set (q := add_square_q (add_square_q 0 ax bx d zx) ay by_ d zy) in *.
  assert (D' : 0 < IZR d) by (apply IZR_lt; lia). assert (E' : 0 < IZR dr) by (apply IZR_lt; lia).
  rewrite <- (sgn_scale (IZR d * IZR d * IZR dr) (_ - coordinate ar br c dr)) by (repeat apply Rmult_lt_0_compat;
    assumption). f_equal.
  rewrite !minus_IZR, !mult_IZR.
  transitivity ((IZR p + IZR q * sqrt (IZR c)) * IZR dr - IZR d * IZR d * (IZR ar + IZR br * sqrt (IZR c))); [ring|].
  rewrite S. unfold coordinate. field. lra.
Qed.

(* C src/predicate/circle.c within_slab
  const dyd_icircle *k = &q->circle;
  mpz_mul_2exp(q->s, b, 1);
  for (int side = 0; side < 2; side++) {
    mpz_srcptr bound = side ? s->hi2 : s->lo2;
    if (!bound) continue;
    mpz_mul_2exp(q->t, a, 1);
    mpz_submul(q->t, bound, k->d);
    int sign = dyd_sqrt_sign(q->t, q->s, k->c);
    if (side ? sign > 0 : sign < 0) return false;
  }
  return true;
*)
Definition within_low (a b c d lo2 : Z) : bool := negb (sqrt_sign (a * 2 - lo2 * d) (b * 2) c <? 0)%Z.
Definition within_high (a b c d hi2 : Z) : bool := negb (0 <? sqrt_sign (a * 2 - hi2 * d) (b * 2) c)%Z.

Lemma within_sign a b c d t2 : (0 <= c)%Z -> (0 < d)%Z ->
  sqrt_sign (a * 2 - t2 * d) (b * 2) c = sgn (coordinate a b c d - IZR t2 / 2).
Proof.
  intros C D. rewrite sqrt_sign_correct by exact C. assert (D' : 0 < IZR d) by (apply IZR_lt; lia).
  rewrite <- (sgn_scale (2 * IZR d) (coordinate a b c d - IZR t2 / 2)) by lra. f_equal.
  unfold coordinate. rewrite minus_IZR, !mult_IZR. field. lra.
Qed.

(** The bounds of a slab are halves of lo2 and hi2. *)
Theorem within_correct a b c d lo2 hi2 : (0 <= c)%Z -> (0 < d)%Z ->
  (within_low a b c d lo2 = true <-> IZR lo2 / 2 <= coordinate a b c d) /\
  (within_high a b c d hi2 = true <-> coordinate a b c d <= IZR hi2 / 2).
Proof.
  intros C D. unfold within_low, within_high. rewrite !within_sign by assumption. split.
  - destruct (sgn_cases (coordinate a b c d - IZR lo2 / 2)) as [[X ->]|[[X ->]|[X ->]]]; simpl; split; intros H;
    try reflexivity; try discriminate; lra.
  - destruct (sgn_cases (coordinate a b c d - IZR hi2 / 2)) as [[X ->]|[[X ->]|[X ->]]]; simpl; split; intros H;
    try reflexivity; try discriminate; lra.
Qed.
