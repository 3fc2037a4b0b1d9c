(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [FLT-DST] The bounds that need the inner side of an outward box: ds^2 from above, dl^2 from below. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core Plus_error Sterbenz Binary.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersDistance.
Open Scope R_scope.

(* any src/skeleton/rects_filter.h: return m * {} + 0x1p-1074; *)
(* any src/skeleton/rects_filter.h: return m * 0x1p-52 + {}; *)
(* C src/skeleton/rects_filter.h dyd_ds2_upper
  double dx = dyd_max(b->e[0] - c->e[0], c->e[1] - b->e[1]) + slack;
  double dy = dyd_max(b->e[2] - c->e[2], c->e[3] - b->e[3]) + slack;
  if (!(dx <= DBL_MAX && dy <= DBL_MAX)) return HUGE_VAL;
  dx = dyd_max(dx, 0);
  dy = dyd_max(dy, 0);
  return dyd_upper(dx * dx + dy * dy);
*)
Definition ds2_upper (c b : bbox) (slack : double) : double :=
  let dx := (fmax (e0 b - e0 c) (e1 c - e1 b) + slack)%D in
  let dy := (fmax (e2 b - e2 c) (e3 c - e3 b) + slack)%D in
  if le dx (lit c_dbl_max) && le dy (lit c_dbl_max) then
    let dx := fmax dx (lit c_zero) in
    let dy := fmax dy (lit c_zero) in
    upper (dx * dx + dy * dy)
  else inf.
(* C src/skeleton/rects_filter.h dyd_dl2_lower
  double dx = dyd_max(dyd_max(b->e[1] - c->e[1], c->e[0] - b->e[0]) - slack, 0);
  double dy = dyd_max(dyd_max(b->e[3] - c->e[3], c->e[2] - b->e[2]) - slack, 0);
  return dyd_lower(dx * dx + dy * dy);
*)
Definition dl2_lower (c b : bbox) (slack : double) : double :=
  let dx := fmax (fmax (e1 b - e1 c) (e0 c - e0 b) - slack) (lit c_zero) in
  let dy := fmax (fmax (e3 b - e3 c) (e2 c - e2 b) - slack) (lit c_zero) in
  lower (dx * dx + dy * dy).

(** ** How far an end of an outward box is outside *)

(** x is at most s from the double p, and at most one unit in its last place. *)
Definition outward (p x s : R) : Prop := Rabs (x - p) <= s /\ Rabs (x - p) <= Rmax (2 * u * Rabs p) (2 * eta).

(** Either the difference is exact, or an outward end is off by at most 2^-51 of it. *)
Lemma difference_or_exact p q : format p -> format q ->
  format (p - q) \/ Rmax (2 * u * Rabs p) (2 * eta) <= 4 * u * Rabs (p - q).
Proof.
  intros Fp Fq. generalize eta_pos; intros EP.
  destruct (Rle_or_lt (Rabs (p - q)) (bpow radix2 (-1021))) as [S|S].
  { left. apply (FLT_format_plus_small radix2 (-1074) 53 p (- q) Fp (format_opp _ Fq)). exact S. }
  assert (S' : 2 * eta <= 4 * u * Rabs (p - q)).
  { rewrite bpow_eta in S. simpl (-1021 + 1075)%Z in S. change (bpow radix2 54) with 18014398509481984 in S. unfold u.
  lra. }
  destruct (Rle_or_lt (Rabs (p - q)) (Rabs p / 2)) as [T|T].
  - left. destruct (Rle_or_lt 0 p) as [P|P].
    + rewrite (Rabs_pos_eq p P) in T. apply Rabs_le_inv in T.
      replace (p - q) with (- (q - p)) by ring. apply format_opp. apply sterbenz; try assumption;
        [typeclasses eauto..|lra].
    + rewrite (Rabs_left p P) in T. apply Rabs_le_inv in T.
      replace (p - q) with (- q - - p) by ring. apply sterbenz; try (now apply format_opp); [typeclasses eauto..|lra].
  - right. apply Rmax_lub; [|exact S']. replace (4 * u * Rabs (p - q)) with (2 * u * (2 * Rabs (p - q))) by ring.
    apply Rmult_le_compat_l; [unfold u|]; lra.
Qed.

(** The difference t = x - q, or q - x, for an end p = x but for an error that s covers. *)
Lemma slack_upper d p q t s : format p -> format q -> d = p - q \/ d = q - p -> 0 <= s ->
  Rabs (t - d) <= s -> Rabs (t - d) <= Rmax (2 * u * Rabs p) (2 * eta) -> 0 <= t -> t * (1 - u) <= rnd d + s.
Proof.
  intros Fp Fq D Ps S O Pt. generalize u_pos; intros UP.
  assert (E : format d \/ Rmax (2 * u * Rabs p) (2 * eta) <= 4 * u * Rabs d).
  { destruct (difference_or_exact p q Fp Fq) as [G|G]; destruct D as [-> | ->]; [now left| |now right|right].
    - left. replace (q - p) with (- (p - q)) by ring. now apply format_opp.
    - now rewrite Rabs_minus_sym in G at 1. }
  assert (R1 : Rabs (rnd d - d) <= u * Rabs d).
  { destruct D as [-> | ->]; [apply (rnd_sub_error p q)|apply (rnd_sub_error q p)]; assumption. }
  apply Rabs_le_inv in S. assert (tu : 0 <= t * u) by (apply Rmult_le_pos; lra).
  destruct E as [E|E].
  - rewrite rnd_id by exact E. lra.
  - destruct (Rle_or_lt 0 d) as [P|P].
    + rewrite (Rabs_pos_eq d P) in R1. apply Rabs_le_inv in R1.
      assert (t * u <= (d + s) * u) by (apply Rmult_le_compat_r; lra).
      assert (s * u <= s * 1 \/ True) by now right.
      assert (0 <= s * u) by (apply Rmult_le_pos; lra).
      assert (t * (1 - u) <= (d + s) * (1 - u)) by (apply Rmult_le_compat_r; [unfold u; lra|lra]). lra.
    + exfalso. rewrite (Rabs_left d P) in E. apply Rabs_le_inv in O. unfold u in *. lra.
Qed.

Lemma slack_lower d p q t s : format p -> format q -> d = p - q \/ d = q - p -> 0 <= s ->
  Rabs (t - d) <= s -> Rabs (t - d) <= Rmax (2 * u * Rabs p) (2 * eta) -> 0 < rnd d - s -> rnd d - s <= t * (1 + 101 /
    100 * u).
Proof.
  intros Fp Fq D Ps S O Pr. generalize u_pos; intros UP.
  assert (E : format d \/ Rmax (2 * u * Rabs p) (2 * eta) <= 4 * u * Rabs d).
  { destruct (difference_or_exact p q Fp Fq) as [G|G]; destruct D as [-> | ->]; [now left| |now right|right].
    - left. replace (q - p) with (- (p - q)) by ring. now apply format_opp.
    - now rewrite Rabs_minus_sym in G at 1. }
  assert (R1 : Rabs (rnd d - d) <= u * Rabs d).
  { destruct D as [-> | ->]; [apply (rnd_sub_error p q)|apply (rnd_sub_error q p)]; assumption. }
  apply Rabs_le_inv in S. destruct E as [E|E].
  - rewrite rnd_id in * by exact E. assert (0 <= t * u) by (apply Rmult_le_pos; lra). lra.
  - apply Rabs_le_inv in R1. destruct (Rle_or_lt 0 d) as [P|P].
    + rewrite (Rabs_pos_eq d P) in *. apply Rabs_le_inv in O. unfold u in *. lra.
    + rewrite (Rabs_left d P) in *. unfold u in *. lra.
Qed.

(** ** The rectangle [x0, x1] and its outward ends; slack is infinite when an end is. *)
Definition slack_ok (slack b0 b1 : double) (x0 x1 : R) : Prop :=
  slack = inf \/ (finite slack /\ 0 <= val slack /\ finite b0 /\ finite b1 /\
    outward (val b0) x0 (val slack) /\ outward (val b1) x1 (val slack)).

(** ** Upper bounds of ds^2 *)

(** f + s is at least r, or f is infinite, or r is negative. *)
Definition hs (s : R) (f : double) (r : R) : Prop :=
  f = inf \/ (finite f /\ (0 <= r -> r * (1 - u) <= val f + s)) \/ (f = ninf /\ r < 0).

Lemma hs_le s f r t : hs s f t -> r <= t -> hs s f r.
Proof.
  intros [H|[[F H]|[H N]]] L; [now left|right; left|right; right; split; [exact H|lra]].
  split; [exact F|]. intros P. apply Rle_trans with (t * (1 - u)); [|apply H; lra].
  apply Rmult_le_compat_r; [unfold u; lra|exact L].
Qed.

Lemma hs_sub f g d t s : finite f -> finite g -> d = val f - val g -> val s < bpow radix2 1024 ->
  (0 <= t -> t * (1 - u) <= rnd d + val s) -> hs (val s) (f - g)%D t.
Proof.
  intros Ff Fg -> Hs H. destruct (fsub_total f g Ff Fg) as [[F E]|[[E A]|[E A]]].
  - right; left. split; [exact F|]. now rewrite E.
  - now left.
  - right; right. split; [exact E|]. destruct (Rle_or_lt 0 t) as [P|P]; [|exact P].
    assert (0 <= t * (1 - u)) by (apply Rmult_le_pos; [exact P|unfold u; lra]). specialize (H P). lra.
Qed.

Lemma hs_max s f g r q : hs s f r -> hs s g q -> hs s (fmax f g) (Rmax r q).
Proof.
  intros F G. unfold fmax. destruct F as [->|[[F VF]|[-> NF]]]; destruct G as [->|[[G VG]|[-> NG]]].
  - left; reflexivity.
  - left. now rewrite gt_of_inf.
  - left; reflexivity.
  - left. replace (gt f inf) with false; [reflexivity|]. destruct f; try discriminate; reflexivity.
  - right; left. generalize (gt_finite f g F G). destruct (gt f g); intros [I J].
    + specialize (I eq_refl). split; [exact F|]. intros P. destruct (Rle_or_lt q r) as [L|L].
      * rewrite Rmax_left in * by exact L. now apply VF.
      * rewrite Rmax_right in * by lra. specialize (VG P). lra.
    + assert (L0 : val f <= val g) by (destruct (Rle_or_lt (val f) (val g)) as [L|L]; [exact L|discriminate (J L)]).
      split; [exact G|]. intros P. destruct (Rle_or_lt q r) as [L|L].
      * rewrite Rmax_left in * by exact L. specialize (VF P). lra.
      * rewrite Rmax_right in * by lra. now apply VG.
  - right; left. replace (gt f ninf) with true by (destruct f; try discriminate; reflexivity).
    split; [exact F|]. intros P. destruct (Rle_or_lt q r) as [L|L]; [rewrite Rmax_left in * by exact L; now apply VF|].
    rewrite Rmax_right in P by lra. lra.
  - left; reflexivity.
  - right; left. rewrite (gt_ninf g G). split; [exact G|]. intros P.
    destruct (Rle_or_lt q r) as [L|L]; [rewrite Rmax_left in P by exact L; lra|rewrite Rmax_right in * by lra;
      now apply VG].
  - right; right. split; [reflexivity|]. destruct (Rle_or_lt q r); [rewrite Rmax_left|rewrite Rmax_right]; lra.
Qed.

Lemma hs_clip slack f r : finite slack -> hs (val slack) f r -> le (f + slack)%D (lit c_dbl_max) = true ->
  upb (fmax (f + slack) (lit c_zero)) (Rmax r 0 * ((1 - u) * (1 - u))).
Proof.
  intros Fs H L. destruct zero_lit as [Fz Vz]. assert (Fm : finite (lit c_dbl_max)) by (apply lit_correct; reflexivity).
  assert (U1 : 0 < (1 - u) * (1 - u)) by (unfold u; lra).
  assert (Z : r < 0 \/ r = 0 -> Rmax r 0 * ((1 - u) * (1 - u)) = 0) by (intros K; rewrite Rmax_right by lra; ring).
  destruct H as [->|[[F H]|[-> N]]].
  - exfalso. rewrite inf_add, le_inf in L by assumption. discriminate.
  - assert (P : 0 <= r -> r * ((1 - u) * (1 - u)) <= rnd (val f + val slack)).
    { intros P. specialize (H P). assert (0 <= r * (1 - u)) by (apply Rmult_le_pos; [exact P|unfold u; lra]).
      apply Rle_trans with ((val f + val slack) * (1 - u)); [|apply rnd_add_lower; try apply val_format; lra].
      rewrite <- Rmult_assoc. apply Rmult_le_compat_r; [unfold u; lra|exact H]. }
    unfold fmax. destruct (fadd_total f slack F Fs) as [[G E]|[[E A]|[E A]]].
    + right. generalize (gt_finite (f + slack)%D (lit c_zero) G Fz). rewrite Vz, E.
      destruct (gt (f + slack) (lit c_zero)); intros [I J].
      * specialize (I eq_refl). split; [exact G|]. rewrite E. split; [lra|].
        destruct (Rle_or_lt 0 r) as [Q|Q]; [rewrite Rmax_left by exact Q; now apply P|rewrite Z by (now left); lra].
      * split; [exact Fz|]. rewrite Vz. split; [lra|].
        destruct (Rle_or_lt 0 r) as [Q|Q]; [rewrite Rmax_left by exact Q|rewrite Z by (now left); lra].
        specialize (P Q). destruct (Rle_or_lt (rnd (val f + val slack)) 0) as [K|K]; [lra|discriminate (J K)].
    + exfalso. rewrite E, le_inf in L by assumption. discriminate.
    + right. rewrite E, (gt_ninf _ Fz). split; [exact Fz|]. rewrite Vz. split; [lra|].
      destruct (Rle_or_lt 0 r) as [Q|Q]; [|rewrite Z by (now left); lra].
      specialize (P Q). assert (0 <= r * ((1 - u) * (1 - u))) by (apply Rmult_le_pos; lra).
      generalize (bpow_gt_0 radix2 1024). lra.
  - right. unfold fmax. rewrite ninf_add, (gt_ninf _ Fz) by exact Fs. split; [exact Fz|]. rewrite Vz, Z by (now left).
  lra.
Qed.

Lemma val_lt_W s : val s < bpow radix2 1024.
Proof. generalize (val_lt_max s) (Rle_abs (val s)); lra. Qed.

Lemma axis_ds_upper slack c0 c1 b0 b1 c x0 x1 : lower_end c0 c -> upper_end c1 c -> slack_ok slack b0 b1 x0 x1 ->
  let dx := (fmax (b0 - c0) (c1 - b1) + slack)%D in
  le dx (lit c_dbl_max) = true -> upb (fmax dx (lit c_zero)) (Ds x0 x1 c * ((1 - u) * (1 - u))).
Proof.
  intros C0 C1 [->|(Fs & Ps & F0 & F1 & [O1 O2] & [O3 O4])] dx L.
  { unfold dx in L. rewrite le_add_inf in L; [discriminate|]. apply lit_correct; reflexivity. }
  assert (A : hs (val slack) (b0 - c0) (x0 - c)).
  { destruct C0 as [->|[F V]]; [left; now apply sub_ninf|].
    apply hs_le with (x0 - val c0); [|lra]. apply (hs_sub _ _ _ _ _ F0 F eq_refl (val_lt_W _)).
    intros P. apply (slack_upper _ (val b0) (val c0)); try apply val_format; try assumption; [now left| |];
      replace (x0 - val c0 - (val b0 - val c0)) with (x0 - val b0) by ring; assumption. }
  assert (B : hs (val slack) (c1 - b1) (c - x1)).
  { destruct C1 as [->|[F V]]; [left; now apply inf_sub|].
    apply hs_le with (val c1 - x1); [|lra]. apply (hs_sub _ _ _ _ _ F F1 eq_refl (val_lt_W _)).
    intros P. apply (slack_upper _ (val b1) (val c1)); try apply val_format; try assumption; [now right| |];
      replace (val c1 - x1 - (val c1 - val b1)) with (- (x1 - val b1)) by ring; now rewrite Rabs_Ropp. }
  unfold dx, Ds. apply hs_clip; [exact Fs|now apply hs_max|exact L].
Qed.

Theorem ds2_upper_correct c b slack cx cy x0 x1 y0 y1 :
  lower_end (e0 c) cx -> upper_end (e1 c) cx -> lower_end (e2 c) cy -> upper_end (e3 c) cy ->
  slack_ok slack (e0 b) (e1 b) x0 x1 -> slack_ok slack (e2 b) (e3 b) y0 y1 ->
  ds2_upper c b slack = inf \/ (finite (ds2_upper c b slack) /\
    Ds x0 x1 cx * Ds x0 x1 cx + Ds y0 y1 cy * Ds y0 y1 cy <= val (ds2_upper c b slack)).
Proof.
  intros C0 C1 C2 C3 X Y. unfold ds2_upper. cbv zeta.
  destruct (le (fmax (e0 b - e0 c) (e1 c - e1 b) + slack) (lit c_dbl_max)) eqn:Lx; [|now left].
  destruct (le (fmax (e2 b - e2 c) (e3 c - e3 b) + slack) (lit c_dbl_max)) eqn:Ly; [|now left]. cbn [andb].
  pose proof (axis_ds_upper _ _ _ _ _ _ _ _ C0 C1 X Lx) as Ux. pose proof (axis_ds_upper _ _ _ _ _ _ _ _ C2 C3 Y Ly)
    as Uy.
  set (dx := Ds x0 x1 cx) in *. set (dy := Ds y0 y1 cy) in *.
  assert (Px : 0 <= dx) by apply Rmax_r. assert (Py : 0 <= dy) by apply Rmax_r.
  assert (U1 : 0 <= (1 - u) * (1 - u)) by (unfold u; lra).
  pose proof (upb_sqr _ _ (Rmult_le_pos _ _ Px U1) Ux) as Sx. pose proof (upb_sqr _ _ (Rmult_le_pos _ _ Py U1) Uy) as
    Sy.
  pose proof (upb_add _ _ _ _ Sx Sy) as S.
  assert (P : 0 <= dx * dx + dy * dy) by (generalize (Rle_0_sqr dx) (Rle_0_sqr dy); unfold Rsqr; lra).
  apply upper_correct; [exact P|].
  assert (M : (dx * dx + dy * dy) * (1 - 62 / 10 * u) - 4 * eta <=
    (dx * ((1 - u) * (1 - u)) * (dx * ((1 - u) * (1 - u))) * (1 - u) - eta
     + (dy * ((1 - u) * (1 - u)) * (dy * ((1 - u) * (1 - u))) * (1 - u) - eta)) * (1 - u)).
  { replace ((dx * ((1 - u) * (1 - u)) * (dx * ((1 - u) * (1 - u))) * (1 - u) - eta
     + (dy * ((1 - u) * (1 - u)) * (dy * ((1 - u) * (1 - u))) * (1 - u) - eta)) * (1 - u))
      with ((dx * dx + dy * dy) * (1 - u) ^ 6 - 2 * (1 - u) * eta) by ring.
    apply Rplus_le_compat; [apply Rmult_le_compat_l; [exact P|unfold u; lra]|generalize eta_pos; unfold u; lra]. }
  destruct S as [S|[F [Q V]]]; [left; exact S|right; split; [exact F|split; [exact Q|lra]]].
Qed.

(** ** Lower bounds of dl^2 *)

(** The slack f - s that is left is at most r. *)
Definition ls (s : R) (f : double) (r : R) : Prop :=
  (f = inf /\ W / 2 <= r) \/ (finite f /\ (0 < val f - s -> val f - s <= r)) \/ f = ninf.

Lemma ls_le s f r t : ls s f r -> r <= t -> ls s f t.
Proof. intros [[H A]|[[F H]|H]] L; [left; split; [exact H|lra]|right; left; split; [exact F|intros P;
  specialize (H P); lra]|now right; right]. Qed.

Lemma ls_max s f g r q t : ls s f r -> ls s g q -> r <= t -> q <= t -> ls s (fmax f g) t.
Proof. intros F G R Q. unfold fmax. destruct (gt f g); [now apply (ls_le s f r)|now apply (ls_le s g q)]. Qed.

Lemma ls_sub f g p q t s : finite f -> finite g -> 0 <= val s -> finite s ->
  (p = val f /\ q = val g) \/ (p = val g /\ q = val f) ->
  Rabs (t - (val f - val g)) <= val s -> Rabs (t - (val f - val g)) <= Rmax (2 * u * Rabs p) (2 * eta) ->
  ls (val s) (f - g)%D (t * (1 + 101 / 100 * u)).
Proof.
  intros Ff Fg Ps Fs PQ S O.
  assert (Fp : format p /\ format q) by (destruct PQ as [[-> ->]|[-> ->]]; split; apply val_format).
  destruct Fp as [Fp Fq].
  assert (D : val f - val g = p - q \/ val f - val g = q - p) by (destruct PQ as [[-> ->]|[-> ->]]; tauto).
  assert (K := slack_lower _ p q t (val s) Fp Fq D Ps S O).
  destruct (fsub_total f g Ff Fg) as [[F E]|[[E A]|[E A]]].
  - right; left. split; [exact F|]. now rewrite E.
  - left. split; [exact E|].
    (* d >= W (1 - u), the error is at most 2 u W *)
    assert (R1 : Rabs (rnd (val f - val g) - (val f - val g)) <= u * Rabs (val f - val g)) by (apply rnd_sub_error;
      apply val_format).
    assert (Pp : Rabs p < W) by (destruct PQ as [[-> _]|[-> _]]; apply val_lt_max).
    assert (EW : 2 * eta <= 2 * u * W).
    { replace (2 * eta) with (bpow radix2 (-1074)) by (rewrite bpow_eta; simpl (-1074 + 1075)%Z;
      change (bpow radix2 1) with 2; ring).
      replace (2 * u * W) with (bpow radix2 (-52) * W).
      - rewrite <- bpow_plus. apply bpow_le; lia.
      - unfold u. change (bpow radix2 (-52)) with (/ 4503599627370496). lra. }
    assert (M : Rmax (2 * u * Rabs p) (2 * eta) <= 2 * u * W).
    { apply Rmax_lub; [apply Rmult_le_compat_l; [unfold u|]; lra|exact EW]. }
    apply Rabs_le_inv in O. apply Rabs_le_inv in R1. generalize W_big; intros WB.
    destruct (Rle_or_lt 0 (val f - val g)) as [P|P].
    + rewrite (Rabs_pos_eq _ P) in R1. unfold u in *. lra.
    + rewrite (Rabs_left _ P) in R1. unfold u in *. lra.
  - right; right; exact E.
Qed.

Lemma ls_clip slack f r : finite slack -> ls (val slack) f r -> lob (fmax (f - slack) (lit c_zero)) (Rmax r 0 * (1 +
  u)).
Proof.
  intros Fs H. destruct zero_lit as [Fz Vz]. generalize u_pos W_big; intros UP WB.
  assert (M : forall q, q <= r -> 0 <= r -> q <= Rmax r 0 * (1 + u)).
  { intros q Q P. rewrite Rmax_left by exact P. assert (0 <= r * u) by (apply Rmult_le_pos; lra). lra. }
  assert (Z : lob (lit c_zero) (Rmax r 0 * (1 + u))).
  { left. split; [exact Fz|]. rewrite Vz. split; [lra|]. apply Rmult_le_pos; [apply Rmax_r|lra]. }
  unfold fmax. destruct (gt (f - slack) (lit c_zero)) eqn:G; [|exact Z].
  destruct H as [[-> A]|[[F H]| -> ]].
  - rewrite inf_sub by exact Fs. right. split; [reflexivity|]. apply M; lra.
  - destruct (fsub_total f slack F Fs) as [[K E]|[[E A]|[E A]]].
    + left. apply gt_finite in G; [|exact K|exact Fz]. rewrite Vz in G. split; [exact K|]. split; [lra|].
      rewrite E in *. assert (P : 0 < val f - val slack).
      { destruct (Rle_or_lt (val f - val slack) 0) as [P|P]; [|exact P]. apply rnd_le in P.
        rewrite round_0 in P by typeclasses eauto. lra. }
      specialize (H P). rewrite Rmax_left by lra.
      apply Rle_trans with ((val f - val slack) * (1 + u)); [|apply Rmult_le_compat_r; lra].
      apply (rnd_add_upper (val f) (- val slack)); [apply val_format|apply format_opp, val_format|lra].
    + right. split; [exact E|].
      assert (P : 0 < val f - val slack).
      { destruct (Rle_or_lt (val f - val slack) 0) as [P|P]; [|exact P]. apply rnd_le in P.
        rewrite round_0 in P by typeclasses eauto. lra. }
      specialize (H P). rewrite Rmax_left by lra.
      assert (rnd (val f - val slack) <= (val f - val slack) * (1 + u))
        by (apply (rnd_add_upper (val f) (- val slack)); [apply val_format|apply format_opp, val_format|lra]).
      assert ((val f - val slack) * (1 + u) <= r * (1 + u)) by (apply Rmult_le_compat_r; lra). lra.
    + exfalso. rewrite E, (gt_ninf _ Fz) in G. discriminate.
  - exfalso. rewrite ninf_sub, (gt_ninf _ Fz) in G by exact Fs. discriminate.
Qed.

Lemma axis_dl_lower slack c0 c1 b0 b1 c x0 x1 : lower_end c0 c -> upper_end c1 c -> slack_ok slack b0 b1 x0 x1 -> x0
  <= x1 ->
  0 <= Dl x0 x1 c /\
  lob (fmax (fmax (b1 - c1) (c0 - b0) - slack) (lit c_zero)) (Dl x0 x1 c * (1 + 101 / 100 * u) * (1 + u)).
Proof.
  intros C0 C1 H X. destruct zero_lit as [Fz Vz]. generalize u_pos; intros UP.
  assert (P : 0 <= Dl x0 x1 c).
  { unfold Dl. destruct (Rle_or_lt c x0); [apply Rle_trans with (x1 - c); [lra|apply Rmax_r]|
      apply Rle_trans with (c - x0); [lra|apply Rmax_l]]. }
  split; [exact P|]. assert (P' : 0 <= Dl x0 x1 c * (1 + 101 / 100 * u)) by (apply Rmult_le_pos; lra).
  destruct H as [->|(Fs & Ps & F0 & F1 & [O1 O2] & [O3 O4])].
  { unfold fmax at 1. rewrite gt_sub_inf by exact Fz. left. split; [exact Fz|]. rewrite Vz. split; [lra|].
    apply Rmult_le_pos; lra. }
  assert (A : ls (val slack) (b1 - c1) ((x1 - c) * (1 + 101 / 100 * u))).
  { destruct C1 as [->|[F V]]; [right; right; now apply sub_inf|].
    apply ls_le with ((x1 - val c1) * (1 + 101 / 100 * u)); [|apply Rmult_le_compat_r; lra].
    apply (ls_sub _ _ (val b1) (val c1)); try assumption; [now left| |];
      replace (x1 - val c1 - (val b1 - val c1)) with (x1 - val b1) by ring; assumption. }
  assert (B : ls (val slack) (c0 - b0) ((c - x0) * (1 + 101 / 100 * u))).
  { destruct C0 as [->|[F V]]; [right; right; now apply ninf_sub|].
    apply ls_le with ((val c0 - x0) * (1 + 101 / 100 * u)); [|apply Rmult_le_compat_r; lra].
    apply (ls_sub _ _ (val b0) (val c0)); try assumption; [now right| |];
      replace (val c0 - x0 - (val c0 - val b0)) with (- (x0 - val b0)) by ring; now rewrite Rabs_Ropp. }
  assert (C : ls (val slack) (fmax (b1 - c1) (c0 - b0)) (Dl x0 x1 c * (1 + 101 / 100 * u))).
  { apply (ls_max _ _ _ _ _ _ A B); apply Rmult_le_compat_r; try lra; [apply Rmax_r|apply Rmax_l]. }
  apply ls_clip in C; [|exact Fs]. now rewrite Rmax_left in C by exact P'.
Qed.

Theorem dl2_lower_correct c b slack cx cy x0 x1 y0 y1 :
  lower_end (e0 c) cx -> upper_end (e1 c) cx -> lower_end (e2 c) cy -> upper_end (e3 c) cy ->
  slack_ok slack (e0 b) (e1 b) x0 x1 -> slack_ok slack (e2 b) (e3 b) y0 y1 -> x0 <= x1 -> y0 <= y1 ->
  dl2_lower c b slack <> inf /\ (finite (dl2_lower c b slack) ->
    val (dl2_lower c b slack) <= Dl x0 x1 cx * Dl x0 x1 cx + Dl y0 y1 cy * Dl y0 y1 cy).
Proof.
  intros C0 C1 C2 C3 X Y Ox Oy. unfold dl2_lower. cbv zeta.
  destruct (axis_dl_lower _ _ _ _ _ _ _ _ C0 C1 X Ox) as [Px Lx]. destruct (axis_dl_lower _ _ _ _ _ _ _ _ C2 C3 Y Oy)
    as [Py Ly].
  pose proof (lob_add _ _ _ _ (lob_sqr _ _ Lx) (lob_sqr _ _ Ly)) as S.
  set (dx := Dl x0 x1 cx) in *. set (dy := Dl y0 y1 cy) in *.
  assert (P : 0 <= dx * dx + dy * dy) by (generalize (Rle_0_sqr dx) (Rle_0_sqr dy); unfold Rsqr; lra).
  apply lower_correct; [exact P|].
  set (k := 1 + 101 / 100 * u) in *.
  assert (M : (dx * k * (1 + u) * (dx * k * (1 + u)) * (1 + u) + eta + (dy * k * (1 + u) * (dy * k * (1 + u)) * (1 +
    u) + eta)) * (1 + u)
    <= (dx * dx + dy * dy) * (1 + 62 / 10 * u) + 4 * eta).
  { replace ((dx * k * (1 + u) * (dx * k * (1 + u)) * (1 + u) + eta + (dy * k * (1 + u) * (dy * k * (1 + u)) * (1 + u)
    + eta)) * (1 + u))
      with ((dx * dx + dy * dy) * (k * k * (1 + u) ^ 4) + 2 * (1 + u) * eta) by ring.
    apply Rplus_le_compat; [apply Rmult_le_compat_l; [exact P|unfold k, u; lra]|generalize eta_pos; unfold u; lra]. }
  destruct S as [[F [P0 V]]|[E A]]; [left|right]; (split; [assumption|]); lra.
Qed.
