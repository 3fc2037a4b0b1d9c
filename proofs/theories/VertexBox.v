(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* How far a place is at most from the circumcentres of all choices of three rectangles, in exact numbers [VERT-1]. *)
From Coq Require Import Reals Lra Psatz.
From Dyadel Require Import Plane Distance.
Open Scope R_scope.

(* A product of two numbers near x and y. *)
Lemma product_near x y u v r s : Rabs (u - x) <= r -> Rabs (v - y) <= s ->
  Rabs (u * v - x * y) <= r * (Rabs y + s) + Rabs x * s.
Proof.
  intros U V. replace (u * v - x * y) with ((u - x) * v + x * (v - y)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _). rewrite !Rabs_mult. pose proof (Rabs_triang (v - y) y) as W.
  replace (v - y + y) with v in W by ring. pose proof (Rabs_pos (u - x)). pose proof (Rabs_pos x).
  apply Rplus_le_compat; [| now apply Rmult_le_compat_l]. apply Rmult_le_compat; try lra. apply Rabs_pos.
Qed.

(* Twice the area of the triangle of a and b is no less than at the middles, less its possible variation. *)
Theorem cross_least ax ay kx ky rax ray rkx rky px py qx qy : Rabs (px - ax) <= rax -> Rabs (py - ay) <= ray ->
  Rabs (qx - kx) <= rkx -> Rabs (qy - ky) <= rky ->
  Rabs (ax * ky - ay * kx) - (rax * (Rabs ky + rky) + Rabs ax * rky + ray * (Rabs kx + rkx) + Rabs ay * rkx) <=
    Rabs (px * qy - py * qx).
Proof.
  intros A B C D. pose proof (product_near ax ky px qy rax rky A D) as P. pose proof (product_near ay kx py qx ray rkx B C)
    as Q.
  pose proof (Rabs_triang (px * qy - py * qx) (- (px * qy - ax * ky))) as T. rewrite Rabs_Ropp in T.
  pose proof (Rabs_triang (px * qy - py * qx + - (px * qy - ax * ky)) (py * qx - ay * kx)) as U.
  replace (px * qy - py * qx + - (px * qy - ax * ky) + (py * qx - ay * kx)) with (ax * ky - ay * kx) in U by ring.
  lra.
Qed.

(* By how much the squares of the distances of two points from z differ. *)
Theorem gap_most z P Q p q : inside p P -> inside q Q ->
  Rabs (dist2 q z - dist2 p z) <= Rmax (dl z Q * dl z Q - ds z P * ds z P) (dl z P * dl z P - ds z Q * ds z Q).
Proof.
  intros Ip Iq.
  assert (S : forall x X, inside x X -> ds z X * ds z X <= dist2 x z <= dl z X * dl z X).
  { intros x X I. replace (dist2 x z) with (dist z x * dist z x) by (rewrite dist_sq; unfold dist2; ring).
    pose proof (ds_le z X x I). pose proof (le_dl z X x I). pose proof (ds_nonneg z X). pose proof (dist_nonneg z x).
    split; apply Rmult_le_compat; lra. }
  pose proof (S p P Ip). pose proof (S q Q Iq). unfold Rabs. destruct (Rcase_abs _).
  - apply Rle_trans with (2 := Rmax_r _ _). lra.
  - apply Rle_trans with (2 := Rmax_l _ _). lra.
Qed.

(* c is as far from p, q, r, with q - p near a, r - p near b; A and B are how much farther the squares of q and r are
   from z than that of p, at most; l is below |(q - p) x (r - p)|. *)
Theorem vertex_near c z p q r ax ay kx ky rax ray rkx rky A B l : dist2 q c = dist2 p c -> dist2 r c = dist2 p c ->
  Rabs (fst q - fst p - ax) <= rax -> Rabs (snd q - snd p - ay) <= ray -> Rabs (fst r - fst p - kx) <= rkx ->
  Rabs (snd r - snd p - ky) <= rky -> Rabs (dist2 q z - dist2 p z) <= A -> Rabs (dist2 r z - dist2 p z) <= B -> 0 < l ->
  l <= Rabs ((fst q - fst p) * (snd r - snd p) - (snd q - snd p) * (fst r - fst p)) ->
  Rabs (fst c - fst z) <= (A * (Rabs ky + rky) + B * (Rabs ay + ray)) / (2 * l) /\
  Rabs (snd c - snd z) <= (B * (Rabs ax + rax) + A * (Rabs kx + rkx)) / (2 * l).
Proof.
  intros Eq Er Ax Ay Bx By HA HB L D. set (ux := fst q - fst p) in *. set (uy := snd q - snd p) in *.
  set (vx := fst r - fst p) in *. set (vy := snd r - snd p) in *. set (d := ux * vy - uy * vx) in *.
  set (hx := fst c - fst z) in *. set (hy := snd c - snd z) in *. set (a := dist2 q z - dist2 p z) in *.
  set (b := dist2 r z - dist2 p z) in *.
  assert (Ea : 2 * (ux * hx + uy * hy) = a).
  { unfold a, ux, uy, hx, hy, dist2 in *. lra. }
  assert (Eb : 2 * (vx * hx + vy * hy) = b).
  { unfold b, vx, vy, hx, hy, dist2 in *. lra. }
  assert (Near : forall u x s, Rabs (u - x) <= s -> Rabs u <= Rabs x + s).
  { intros u x s H. pose proof (Rabs_triang (u - x) x) as T. replace (u - x + x) with u in T by ring. lra. }
  assert (One : forall h m n f g M K, 2 * d * h = m * f - n * g -> Rabs m <= M -> Rabs n <= K ->
    forall F G, Rabs f <= F -> Rabs g <= G -> Rabs h <= (M * F + K * G) / (2 * l)).
  { intros h m n f g M K E Hm Hn F G Hf Hg. apply Rmult_le_reg_r with (2 * l); [lra |].
    replace ((M * F + K * G) / (2 * l) * (2 * l)) with (M * F + K * G) by (field; lra).
    apply Rle_trans with (Rabs (2 * d * h)).
    - rewrite !Rabs_mult, (Rabs_right 2) by lra. pose proof (Rabs_pos h). nra.
    - rewrite E. unfold Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp, !Rabs_mult.
      apply Rplus_le_compat; apply Rmult_le_compat; auto using Rabs_pos. }
  split.
  - apply (One hx a b vy uy A B); auto. unfold d. rewrite <- Ea, <- Eb. ring.
  - apply (One hy b a ux vx B A); auto. unfold d. rewrite <- Ea, <- Eb. ring.
Qed.
