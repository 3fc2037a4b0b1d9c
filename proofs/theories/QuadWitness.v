(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* A circle that meets four rectangles, two of them surely on opposite sides of the two others, leaves the two others
   without a witness. *)
From Coq Require Import Reals Lra Psatz Classical.
From Dyadel Require Import Plane Distance Cells Legal Orientation Disc PartialDisc.
Open Scope R_scope.

(* Two chords of one circle meet, if the ends of the one are on opposite sides of the other. *)
Lemma chords_meet o r i j a b : circle o r i j a -> dist o b = r -> 0 < orient i j a -> orient i j b < 0 ->
  exists s t, 0 <= s <= 1 /\ 0 <= t <= 1 /\ mix s i j = mix t a b.
Proof.
  intros [Ei [Ej Ea]] Eb A B. set (u := orient i j a) in *. set (v := orient i j b) in *.
  set (t := u / (u - v)). assert (I : 0 < / (u - v)) by (apply Rinv_0_lt_compat; lra).
  assert (T : 0 <= t <= 1).
  { unfold t. split; [apply Rmult_le_pos; lra |]. apply (Rmult_le_reg_r (u - v)); [lra |].
    unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  set (z := mix t a b).
  assert (Z0 : orient i j z = 0).
  { transitivity ((1 - t) * u + t * v); [unfold z, u, v, orient, mix; simpl; ring |]. unfold t. field. lra. }
  assert (Zr : dist o z <= r) by (apply disc_convex; [exact T | lra | lra]).
  (* z is on the line ij, at i + k (j - i) *)
  assert (D : i <> j) by (intros ->; unfold u, orient in A; nra).
  set (q := dist2 i j). assert (Q : 0 < q) by (unfold q; rewrite <- dist_sq; pose proof (dist_pos i j D); nra).
  set (k := ((fst j - fst i) * (fst z - fst i) + (snd j - snd i) * (snd z - snd i)) / q).
  assert (Kq : k * q = (fst j - fst i) * (fst z - fst i) + (snd j - snd i) * (snd z - snd i)) by (unfold k; field; lra).
  assert (Zx : fst z = fst i + k * (fst j - fst i)).
  { apply (Rmult_eq_reg_l q); [| lra]. rewrite Rmult_plus_distr_l, <- Rmult_assoc, (Rmult_comm q k), Kq.
    apply Rminus_diag_uniq. transitivity (- (snd j - snd i) * orient i j z); [unfold q, dist2, orient; ring | rewrite Z0; ring]. }
  assert (Zy : snd z = snd i + k * (snd j - snd i)).
  { apply (Rmult_eq_reg_l q); [| lra]. rewrite Rmult_plus_distr_l, <- Rmult_assoc, (Rmult_comm q k), Kq.
    apply Rminus_diag_uniq. transitivity ((fst j - fst i) * orient i j z); [unfold q, dist2, orient; ring | rewrite Z0; ring]. }
  assert (Zm : mix k i j = z).
  { unfold mix. rewrite (surjective_pairing z), Zx, Zy. f_equal; ring. }
  exists k, t. split; [| split; [exact T | now rewrite Zm]].
  assert (P : dist2 o z - r * r = k * (k - 1) * q).
  { rewrite <- Zm, dist2_mix, <- (dist_sq o i), <- (dist_sq o j), Ei, Ej. unfold q. ring. }
  assert (dist2 o z <= r * r).
  { rewrite <- dist_sq. pose proof (dist_nonneg o z). apply Rmult_le_compat; assumption. }
  assert (N : k * (k - 1) * q <= 0) by lra. assert (k * (k - 1) <= 0) by nra. nra.
Qed.

Theorem quad_without_witness N B i j a b : (a < N)%nat -> (b < N)%nat ->
  a <> i -> a <> j -> b <> i -> b <> j ->
  surely_left (B i) (B j) (B a) -> surely_right (B i) (B j) (B b) ->
  (exists x y z w o r, inside x (B i) /\ inside y (B j) /\ inside z (B a) /\ inside w (B b) /\
    circle o r x y z /\ dist o w = r) -> ~ legal N B i j.
Proof.
  intros Ha Hb Dai Daj Dbi Dbj SL SR [x [y [z [w [o [r [Ix [Iy [Iz [Iw [K Ew]]]]]]]]]]] [c W].
  destruct (chords_meet o r x y z w K Ew (SL x y z Ix Iy Iz) (SR x y w Ix Iy Iw)) as [s [t [S [T E]]]].
  destruct K as [Ex [Ey Ez]]. destruct (W a Ha Dai Daj) as [A1 A2]. destruct (W b Hb Dbi Dbj) as [B1 B2].
  set (h := Rmax (dist c x) (dist c y)).
  assert (Hx : dist c x <= h) by apply Rmax_l. assert (Hy : dist c y <= h) by apply Rmax_r.
  assert (Hz : h < dist c z).
  { pose proof (le_dl c _ _ Ix). pose proof (le_dl c _ _ Iy). pose proof (ds_le c _ _ Iz).
    unfold h. apply Rmax_lub_lt; lra. }
  assert (Hw : h < dist c w).
  { pose proof (le_dl c _ _ Ix). pose proof (le_dl c _ _ Iy). pose proof (ds_le c _ _ Iw).
    unfold h. apply Rmax_lub_lt; lra. }
  assert (H0 : 0 <= h) by (pose proof (dist_nonneg c x); lra).
  pose proof (radical_mix c h o r s x y) as L1. pose proof (radical_mix c h o r t z w) as L2. rewrite <- E in L2.
  unfold radical in L1, L2.
  rewrite (power_zero o r x Ex), (power_zero o r y Ey) in L1. rewrite (power_zero o r z Ez), (power_zero o r w Ew) in L2.
  pose proof (power_le c h x Hx). pose proof (power_le c h y Hy).
  pose proof (power_gt c h z H0 Hz). pose proof (power_gt c h w H0 Hw).
  assert (0 <= (1 - s) * - power c h x) by (apply Rmult_le_pos; lra).
  assert (0 <= s * - power c h y) by (apply Rmult_le_pos; lra).
  assert (0 < (1 - t) * power c h z + t * power c h w).
  { destruct (Req_dec t 0) as [-> | T0]; [lra |].
    assert (0 < t * power c h w) by (apply Rmult_lt_0_compat; lra).
    assert (0 <= (1 - t) * power c h z) by (apply Rmult_le_pos; lra). lra. }
  lra.
Qed.
