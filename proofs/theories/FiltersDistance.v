(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [FLT-DST] Bounds of ds^2 and dl^2 in doubles: infinite ends, overflow and underflow included. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core Binary.
From Dyadel Require Import FiltersBase FiltersError FiltersConst.
Open Scope R_scope.

(** ** The C code *)

(** xlo, xhi, ylo, yhi. *)
Record bbox := { e0 : double; e1 : double; e2 : double; e3 : double }.

(* C src/skeleton/rects_filter.h dyd_max
  return a > b ? a : b;
*)
Definition fmax (a b : double) : double := if gt a b then a else b.
(* C src/skeleton/rects_filter.h dyd_lower
  double y = x * DYD_DOWN_FACTOR - DYD_TINY;
  return y > DBL_MAX / 4 ? DBL_MAX / 4 : y;
*)
Definition lower (x : double) : double :=
  let y := (x * lit c_down_factor - lit c_tiny)%D in if gt y (lit c_cut) then lit c_cut else y.
(* C src/skeleton/rects_filter.h dyd_upper
  return x * DYD_UP_FACTOR + DYD_TINY;
*)
Definition upper (x : double) : double := (x * lit c_up_factor + lit c_tiny)%D.
(* C src/skeleton/rects_filter.h dyd_ds2_lower
  double dx = dyd_max(dyd_max(b->e[0] - c->e[1], c->e[0] - b->e[1]), 0);
  double dy = dyd_max(dyd_max(b->e[2] - c->e[3], c->e[2] - b->e[3]), 0);
  return dyd_lower(dx * dx + dy * dy);
*)
Definition ds2_lower (c b : bbox) : double :=
  let dx := fmax (fmax (e0 b - e1 c) (e0 c - e1 b)) (lit c_zero) in
  let dy := fmax (fmax (e2 b - e3 c) (e2 c - e3 b)) (lit c_zero) in
  lower (dx * dx + dy * dy).
(* C src/skeleton/rects_filter.h dyd_dl2_upper
  double dx = dyd_max(b->e[1] - c->e[0], c->e[1] - b->e[0]);
  double dy = dyd_max(b->e[3] - c->e[2], c->e[3] - b->e[2]);
  return dyd_upper(dx * dx + dy * dy);
*)
Definition dl2_upper (c b : bbox) : double :=
  let dx := fmax (e1 b - e0 c) (e1 c - e0 b) in
  let dy := fmax (e3 b - e2 c) (e3 c - e2 b) in
  upper (dx * dx + dy * dy).

(** ** What the ends of boxes say *)

Notation inf := (B754_infinity 53 1024 false).
Notation ninf := (B754_infinity 53 1024 true).
Definition lower_end (f : double) (x : R) : Prop := f = ninf \/ (finite f /\ val f <= x).
Definition upper_end (f : double) (x : R) : Prop := f = inf \/ (finite f /\ x <= val f).

(** Squared distances along the axes; ds clamps, dl goes to the farther end. *)
Definition Ds (x0 x1 c : R) : R := Rmax (Rmax (x0 - c) (c - x1)) 0.
Definition Dl (x0 x1 c : R) : R := Rmax (c - x0) (x1 - c).

Notation W := (bpow radix2 1024).

Lemma W_big : 8 <= W.
Proof. change 8 with (bpow radix2 3). apply bpow_le; lia. Qed.

(** ** Lower bounds *)

(** At most r, or infinite for a reason. *)
Definition lob (f : double) (r : R) : Prop := (finite f /\ 0 <= val f <= r) \/ (f = inf /\ W / 2 <= r).
(** The same, or not positive. *)
Definition lo (f : double) (r : R) : Prop := lob f r \/ f = ninf \/ (finite f /\ val f <= 0).

Lemma zero_lit : finite (lit c_zero) /\ val (lit c_zero) = 0.
Proof.
  destruct (lit_correct c_zero eq_refl) as [F V]. split; [exact F|]. rewrite V. unfold cval; simpl; lra.
Qed.

Lemma lo_sub f g x y : lower_end f x -> upper_end g y -> lo (f - g)%D ((x - y) * (1 + u)).
Proof.
  intros Hf Hg. destruct Hf as [->|[Ff Vf]].
  { right; left. destruct Hg as [->|[Fg _]]; [apply ninf_sub_inf|now apply ninf_sub]. }
  destruct Hg as [->|[Fg Vg]].
  { right; left. now apply sub_inf. }
  assert (K : 0 <= val f - val g -> rnd (val f - val g) <= (x - y) * (1 + u)).
  { intros P. apply Rle_trans with ((val f - val g) * (1 + u)).
    - apply (rnd_add_upper (val f) (- val g)); [apply val_format|apply format_opp, val_format|lra].
    - apply Rmult_le_compat_r; [unfold u; lra|lra]. }
  assert (N : val f - val g < 0 -> rnd (val f - val g) <= 0).
  { intros P. rewrite <- (round_0 radix2 fexp ZnearestE). apply rnd_le; lra. }
  destruct (fsub_total f g Ff Fg) as [[F E]|[[E A]|[E _]]].
  - destruct (Rle_or_lt 0 (val f - val g)) as [P|P].
    + left; left. split; [exact F|]. rewrite E. split; [now apply rnd_pos|now apply K].
    + right; right. split; [exact F|]. rewrite E. now apply N.
  - left; right. split; [exact E|]. destruct (Rle_or_lt 0 (val f - val g)) as [P|P].
    + specialize (K P). generalize (bpow_gt_0 radix2 1024). lra.
    + apply N in P. generalize (bpow_gt_0 radix2 1024). lra.
  - right; left; exact E.
Qed.

Lemma gt_inf f : gt inf f = true -> f <> inf.
Proof. intros H ->. discriminate. Qed.

Lemma lo_max f g r s t : lo f r -> lo g s -> r <= t -> s <= t -> lo (fmax f g) t.
Proof.
  intros F G R S. assert (M : forall h q, q <= t -> lo h q -> lo h t).
  { intros h q Q [[[H1 H2]|[H1 H2]]|H]; [left; left|left; right|now right]; (split; [exact H1|lra]). }
  unfold fmax. destruct (gt f g); [now apply (M _ r)|now apply (M _ s)].
Qed.

Lemma lo_max0 f r : lo f r -> lob (fmax f (lit c_zero)) (Rmax r 0).
Proof.
  destruct zero_lit as [Fz Vz]. intros H.
  assert (Z : lob (lit c_zero) (Rmax r 0)).
  { left. split; [exact Fz|]. rewrite Vz. split; [lra|apply Rmax_r]. }
  assert (M : forall q, q <= r -> q <= Rmax r 0) by (intros q Q; apply Rle_trans with (1 := Q), Rmax_l).
  unfold fmax. destruct (gt f (lit c_zero)) eqn:G; [|exact Z].
  destruct H as [[[F V]|[E A]]|[E|[F V]]].
  - left. split; [exact F|]. split; [lra|]. apply M; lra.
  - right. split; [exact E|now apply M].
  - exfalso. rewrite E in G. destruct (lit c_zero); try discriminate.
  - exfalso. apply gt_finite in G; [lra|exact F|exact Fz].
Qed.

Lemma lob_sqr f r : lob f r -> lob (f * f)%D (r * r * (1 + u) + eta).
Proof.
  generalize eta_pos u_pos W_big; intros EP UP WB. intros [[F [P V]]|[-> A]].
  - assert (Q : val f * val f <= r * r) by (apply Rmult_le_compat; assumption).
    assert (K : rnd (val f * val f) <= r * r * (1 + u) + eta).
    { apply Rle_trans with (1 := rnd_upper _ (Rle_0_sqr _)). unfold Rsqr.
      apply Rplus_le_compat_r, Rmult_le_compat_r; [lra|exact Q]. }
    destruct (fsqr_total f F) as [[G E]|[E B]].
    + left. split; [exact G|]. rewrite E. split; [apply rnd_pos, Rle_0_sqr|exact K].
    + right. split; [exact E|lra].
  - right. split; [apply inf_sqr|].
    assert (W / 2 * (W / 2) <= r * r) by (apply Rmult_le_compat; lra).
    assert (W / 2 * 1 <= W / 2 * (W / 2)) by (apply Rmult_le_compat_l; lra).
    assert (0 <= r * r * u) by (apply Rmult_le_pos; [apply Rle_0_sqr|lra]). lra.
Qed.

Lemma lob_add f g r s : lob f r -> lob g s -> lob (f + g)%D ((r + s) * (1 + u)).
Proof.
  generalize u_pos W_big; intros UP WB.
  assert (R0 : forall h q, lob h q -> 0 <= q) by (intros h q [[_ H]|[_ H]]; lra).
  intros F G. pose proof (R0 _ _ F) as Pr. pose proof (R0 _ _ G) as Ps.
  assert (rs : 0 <= (r + s) * u) by (apply Rmult_le_pos; lra).
  destruct F as [[F [P V]]|[-> A]].
  - destruct G as [[G [Q B]]|[-> A]].
    + assert (K : rnd (val f + val g) <= (r + s) * (1 + u)).
      { apply Rle_trans with ((val f + val g) * (1 + u)); [apply rnd_add_upper; try apply val_format; lra|].
        apply Rmult_le_compat_r; lra. }
      destruct (fadd_total f g F G) as [[H E]|[[E H]|[E H]]].
      * left. split; [exact H|]. rewrite E. split; [apply rnd_pos; lra|exact K].
      * right. split; [exact E|lra].
      * exfalso. assert (0 <= rnd (val f + val g)) by (apply rnd_pos; lra). lra.
    + right. split; [apply add_inf; exact F|lra].
  - right. split; [|lra]. destruct G as [[G _]|[-> _]]; [apply inf_add; exact G|apply inf_inf].
Qed.

Lemma factor_up : 1 + 10 * u <= cval c_up_factor <= 1 + 10 * u.
Proof. unfold c_up_factor, u; split; numerals; lra. Qed.
Lemma factor_down : 1 - 10 * u <= cval c_down_factor <= 1 - 10 * u.
Proof. unfold c_down_factor, u; split; numerals; lra. Qed.
Lemma tiny_eta : cval c_tiny = 37778931862957161709568 * eta.
Proof. unfold c_tiny, cval, fst, snd. rewrite bpow_eta; simpl (-1000 + 1075)%Z; numerals; ring. Qed.
Lemma cut_W : 0 < cval c_cut <= W / 4.
Proof.
  unfold c_cut, cval, fst, snd. replace (W / 4) with (bpow radix2 53 * bpow radix2 969).
  - generalize (bpow_gt_0 radix2 969); intros P. change (bpow radix2 53) with 9007199254740992. lra.
  - rewrite <- bpow_plus. change 1024%Z with (53 + 969 + 2)%Z. rewrite (bpow_plus radix2 (53 + 969) 2).
    change (bpow radix2 2) with 4. field.
Qed.

Lemma lower_correct f d : 0 <= d -> lob f (d * (1 + 62 / 10 * u) + 4 * eta) ->
  lower f <> inf /\ (finite (lower f) -> val (lower f) <= d).
Proof.
  intros Pd H. unfold lower. cbv zeta.
  destruct (lit_correct c_cut eq_refl) as [Fc Vc]. destruct (lit_correct c_tiny eq_refl) as [Ft Vt].
  destruct (lit_correct c_down_factor eq_refl) as [Fd Vd]. pose proof factor_down as D. pose proof tiny_eta as T.
  pose proof cut_W as CW. generalize eta_pos W_big; intros EP WB.
  set (y := (f * lit c_down_factor - lit c_tiny)%D).
  assert (CI : lit c_cut <> inf) by (intros E; rewrite E in Fc; discriminate).
  assert (Cut : W / 2 <= d * (1 + 62 / 10 * u) + 4 * eta -> cval c_cut <= d).
  { intros K. assert (E1 : eta <= 1) by (unfold eta; change 1 with (bpow radix2 0); apply bpow_le; lia).
    assert (W4 : 32 <= W) by (change 32 with (bpow radix2 5); apply bpow_le; lia). unfold u in *. lra. }
  destruct (gt y (lit c_cut)) eqn:G.
  - split; [exact CI|]. intros _. rewrite Vc.
    destruct H as [[F [P V]]|[_ A]]; [|now apply Cut].
    destruct (Rle_or_lt (W / 2) (d * (1 + 62 / 10 * u) + 4 * eta)) as [K|K]; [now apply Cut|].
    assert (Q : finite (f * lit c_down_factor)%D /\ val (f * lit c_down_factor)%D = rnd (val f * val (lit
      c_down_factor))).
    { apply fmul_finite; try assumption. rewrite Vd. rewrite <- rnd_abs.
      apply Rle_lt_trans with (rnd (Rabs (val f))); [|rewrite rnd_id; [apply val_lt_max|rewrite <- fabs_val;
        apply val_format]].
      apply rnd_le. rewrite Rabs_mult, (Rabs_pos_eq (cval _)) by (unfold u in D; lra).
      rewrite <- (Rmult_1_r (Rabs (val f))) at 2. apply Rmult_le_compat_l; [apply Rabs_pos|unfold u in D; lra]. }
    destruct Q as [Q E]. unfold y in G. apply (fsub_gt _ _ _ Q Ft Fc) in G. rewrite E, Vd, Vt, Vc in G.
    set (q := rnd (val f * cval c_down_factor)) in *.
    assert (Q1 : q <= val f * cval c_down_factor * (1 + u) + eta) by (apply rnd_upper, Rmult_le_pos;
      [exact P|unfold u in D; lra]).
    destruct (Rle_or_lt 0 (q - cval c_tiny)) as [S|S].
    + assert (Q2 : rnd (q - cval c_tiny) <= (q - cval c_tiny) * (1 + u)).
      { apply (rnd_add_upper q (- cval c_tiny)); [apply rnd_format|rewrite <- Vt; apply format_opp, val_format|lra]. }
      assert (Q3 : val f * cval c_down_factor <= (d * (1 + 62 / 10 * u) + 4 * eta) * (1 - 10 * u))
        by (apply Rmult_le_compat; unfold u in *; lra).
      rewrite T in *. unfold u in *. lra.
    + assert (rnd (q - cval c_tiny) <= 0) by (rewrite <- (round_0 radix2 fexp ZnearestE); apply rnd_le; lra). lra.
  - destruct H as [[F [P V]]|[-> A]].
    2: { exfalso. revert G. unfold y. rewrite inf_mul_pos; [|exact Fd|rewrite Vd; unfold u in D; lra].
         rewrite inf_sub by exact Ft. now rewrite (gt_of_inf _ Fc). }
    split.
    + intros E. rewrite E in G. rewrite (gt_of_inf _ Fc) in G. discriminate.
    + intros Fy. unfold y in *. destruct (fsub_inv _ _ Fy) as (Q & _ & E). destruct (fmul_inv _ _ Q) as (_ & _ & E').
      rewrite E, E', Vd, Vt.
      set (q := rnd (val f * cval c_down_factor)) in *.
      assert (Q1 : q <= val f * cval c_down_factor * (1 + u) + eta) by (apply rnd_upper, Rmult_le_pos;
        [exact P|unfold u in D; lra]).
      destruct (Rle_or_lt 0 (q - cval c_tiny)) as [S|S].
      * assert (Q2 : rnd (q - cval c_tiny) <= (q - cval c_tiny) * (1 + u)).
        { apply (rnd_add_upper q (- cval c_tiny)); [apply rnd_format|rewrite <- Vt; apply format_opp, val_format|lra]. }
        assert (Q3 : val f * cval c_down_factor <= (d * (1 + 62 / 10 * u) + 4 * eta) * (1 - 10 * u))
          by (apply Rmult_le_compat; unfold u in *; lra).
        rewrite T in *. unfold u in *. lra.
      * assert (rnd (q - cval c_tiny) <= 0) by (rewrite <- (round_0 radix2 fexp ZnearestE); apply rnd_le; lra). lra.
Qed.

(** Ends along one axis: the centre's box [c0, c1], the rectangle's outward box [b0, b1]. *)
Lemma axis_lower c0 c1 b0 b1 c x0 x1 : lower_end c0 c -> upper_end c1 c -> lower_end b0 x0 -> upper_end b1 x1 ->
  lob (fmax (fmax (b0 - c1) (c0 - b1)) (lit c_zero)) (Ds x0 x1 c * (1 + u)).
Proof.
  intros C0 C1 B0 B1. generalize u_pos; intros UP.
  pose proof (lo_sub _ _ _ _ B0 C1) as L1. pose proof (lo_sub _ _ _ _ C0 B1) as L2.
  assert (L : lo (fmax (b0 - c1) (c0 - b1)) (Rmax (x0 - c) (c - x1) * (1 + u))).
  { apply (lo_max _ _ _ _ _ L1 L2); (apply Rmult_le_compat_r; [lra|]); [apply Rmax_l|apply Rmax_r]. }
  apply lo_max0 in L. replace (Ds x0 x1 c * (1 + u)) with (Rmax (Rmax (x0 - c) (c - x1) * (1 + u)) 0); [exact L|].
  unfold Ds. set (m := Rmax (x0 - c) (c - x1)). destruct (Rle_or_lt m 0) as [M|M].
  - rewrite !Rmax_right; [ring|exact M|]. assert (0 <= - m * (1 + u)) by (apply Rmult_le_pos; lra). lra.
  - rewrite !Rmax_left; [reflexivity|lra|]. apply Rmult_le_pos; lra.
Qed.

Theorem ds2_lower_correct c b cx cy x0 x1 y0 y1 :
  lower_end (e0 c) cx -> upper_end (e1 c) cx -> lower_end (e2 c) cy -> upper_end (e3 c) cy ->
  lower_end (e0 b) x0 -> upper_end (e1 b) x1 -> lower_end (e2 b) y0 -> upper_end (e3 b) y1 ->
  ds2_lower c b <> inf /\
  (finite (ds2_lower c b) -> val (ds2_lower c b) <= Ds x0 x1 cx * Ds x0 x1 cx + Ds y0 y1 cy * Ds y0 y1 cy).
Proof.
  intros C0 C1 C2 C3 B0 B1 B2 B3. unfold ds2_lower. cbv zeta.
  pose proof (lob_sqr _ _ (axis_lower _ _ _ _ _ _ _ C0 C1 B0 B1)) as X.
  pose proof (lob_sqr _ _ (axis_lower _ _ _ _ _ _ _ C2 C3 B2 B3)) as Y.
  pose proof (lob_add _ _ _ _ X Y) as S. set (dx := Ds x0 x1 cx) in *. set (dy := Ds y0 y1 cy) in *.
  assert (P : 0 <= dx * dx + dy * dy) by (generalize (Rle_0_sqr dx) (Rle_0_sqr dy); unfold Rsqr; lra).
  apply lower_correct; [exact P|].
  assert (M : (dx * (1 + u) * (dx * (1 + u)) * (1 + u) + eta + (dy * (1 + u) * (dy * (1 + u)) * (1 + u) + eta)) * (1 +
    u)
    <= (dx * dx + dy * dy) * (1 + 62 / 10 * u) + 4 * eta).
  { replace ((dx * (1 + u) * (dx * (1 + u)) * (1 + u) + eta + (dy * (1 + u) * (dy * (1 + u)) * (1 + u) + eta)) * (1 +
    u))
      with ((dx * dx + dy * dy) * (1 + u) ^ 4 + 2 * (1 + u) * eta) by ring.
    apply Rplus_le_compat; [apply Rmult_le_compat_l; [exact P|unfold u; lra]|generalize eta_pos; unfold u; lra]. }
  destruct S as [[F [P0 V]]|[E A]]; [left|right]; (split; [assumption|]); lra.
Qed.

(** ** Upper bounds *)

(** At least r, or infinite. *)
Definition upb (f : double) (r : R) : Prop := f = inf \/ (finite f /\ 0 <= val f /\ r <= val f).
(** The same, unless r is negative. *)
Definition hi (f : double) (r : R) : Prop :=
  f = inf \/ (finite f /\ (0 <= r -> r * (1 - u) <= val f)) \/ (f = ninf /\ r < 0).

Lemma hi_sub f g x y : upper_end f x -> lower_end g y -> hi (f - g)%D (x - y).
Proof.
  intros Hf Hg. destruct Hf as [->|[Ff Vf]].
  { left. destruct Hg as [->|[Fg _]]; [apply inf_sub_ninf|now apply inf_sub]. }
  destruct Hg as [->|[Fg Vg]].
  { left. now apply sub_ninf. }
  assert (K : 0 <= x - y -> (x - y) * (1 - u) <= rnd (val f - val g)).
  { intros P. apply Rle_trans with ((val f - val g) * (1 - u)).
    - apply Rmult_le_compat_r; [unfold u; lra|lra].
    - apply (rnd_add_lower (val f) (- val g)); [apply val_format|apply format_opp, val_format|lra]. }
  destruct (fsub_total f g Ff Fg) as [[F E]|[[E A]|[E A]]].
  - right; left. split; [exact F|]. rewrite E. exact K.
  - left; exact E.
  - right; right. split; [exact E|]. destruct (Rle_or_lt 0 (x - y)) as [P|P]; [|exact P].
    apply K in P as Q. assert (0 <= (x - y) * (1 - u)) by (apply Rmult_le_pos; [exact P|unfold u; lra]).
    generalize (bpow_gt_0 radix2 1024). lra.
Qed.

Lemma hi_max f g r s : hi f r -> hi g s -> 0 <= Rmax r s -> upb (fmax f g) (Rmax r s * (1 - u)).
Proof.
  intros F G P. assert (U1 : 0 <= 1 - u) by (unfold u; lra). unfold fmax.
  assert (PM : 0 <= Rmax r s * (1 - u)) by now apply Rmult_le_pos.
  destruct F as [->|[[F VF]|[-> NF]]]; destruct G as [->|[[G VG]|[-> NG]]].
  - left. reflexivity.
  - left. now rewrite gt_of_inf.
  - left. reflexivity.
  - left. replace (gt f inf) with false; [reflexivity|]. destruct f; try discriminate; reflexivity.
  - generalize (gt_finite f g F G). destruct (gt f g); intros [I J]; right.
    + specialize (I eq_refl). split; [exact F|].
      assert (K : Rmax r s * (1 - u) <= val f).
      { destruct (Rle_or_lt s r) as [L|L]; [rewrite Rmax_left in * by exact L; now apply VF|].
        rewrite Rmax_right in * by lra. specialize (VG P). lra. }
      lra.
    + assert (L0 : val f <= val g) by (destruct (Rle_or_lt (val f) (val g)) as [L|L]; [exact L|discriminate (J L)]).
      split; [exact G|].
      assert (K : Rmax r s * (1 - u) <= val g).
      { destruct (Rle_or_lt s r) as [L|L]; [rewrite Rmax_left in * by exact L; specialize (VF P); lra|].
        rewrite Rmax_right in * by lra. now apply VG. }
      lra.
  - right. replace (gt f ninf) with true by (destruct f; try discriminate; reflexivity).
    rewrite Rmax_left in *; [|destruct (Rle_or_lt s r); [assumption|rewrite Rmax_right in P; lra]..].
    split; [exact F|]. specialize (VF P). lra.
  - left. reflexivity.
  - right. replace (gt ninf g) with false by (destruct g; try discriminate; reflexivity).
    rewrite Rmax_right in *; [|destruct (Rle_or_lt r s); [assumption|rewrite Rmax_left in P; lra]..].
    split; [exact G|]. specialize (VG P). lra.
  - exfalso. destruct (Rle_or_lt s r); [rewrite Rmax_left in P|rewrite Rmax_right in P]; lra.
Qed.

Lemma upb_sqr f r : 0 <= r -> upb f r -> upb (f * f)%D (r * r * (1 - u) - eta).
Proof.
  intros Pr [->|[F [P V]]]; [left; apply inf_sqr|].
  destruct (fsqr_total f F) as [[G E]|[E _]]; [right|left; exact E].
  split; [exact G|]. rewrite E. split; [apply rnd_pos, Rle_0_sqr|].
  apply Rle_trans with (2 := rnd_lower _ (Rle_0_sqr _)). unfold Rsqr.
  assert (Q : r * r <= val f * val f) by (apply Rmult_le_compat; assumption).
  assert (r * r * (1 - u) <= val f * val f * (1 - u)) by (apply Rmult_le_compat_r; [unfold u; lra|exact Q]). lra.
Qed.

Lemma upb_add f g r s : upb f r -> upb g s -> upb (f + g)%D ((r + s) * (1 - u)).
Proof.
  intros [->|[F [P V]]] [->|[G [Q B]]].
  - left; apply inf_inf.
  - left; now apply inf_add.
  - left; now apply add_inf.
  - assert (0 <= rnd (val f + val g)) by (apply rnd_pos; lra).
    destruct (fadd_total f g F G) as [[H0 E]|[[E _]|[_ A]]]; [right|left; exact E|generalize (bpow_gt_0 radix2 1024);
      lra].
    split; [exact H0|]. rewrite E. split; [exact H|].
    apply Rle_trans with ((val f + val g) * (1 - u)).
    + apply Rmult_le_compat_r; [unfold u; lra|lra].
    + apply rnd_add_lower; try apply val_format; lra.
Qed.

Lemma upper_correct f d : 0 <= d -> upb f (d * (1 - 62 / 10 * u) - 4 * eta) ->
  upper f = inf \/ (finite (upper f) /\ d <= val (upper f)).
Proof.
  intros Pd H. unfold upper. destruct (lit_correct c_tiny eq_refl) as [Ft Vt].
  destruct (lit_correct c_up_factor eq_refl) as [Fu Vu]. pose proof factor_up as D. pose proof tiny_eta as T.
  generalize eta_pos; intros EP.
  assert (Pu : 0 < val (lit c_up_factor)) by (rewrite Vu; unfold u in D; lra).
  destruct H as [->|[F [P V]]].
  - left. rewrite inf_mul_pos by assumption. now apply inf_add.
  - destruct (fmul_total_pos f (lit c_up_factor) F Fu P Pu) as [[G E]|[E _]].
    2: { left. rewrite E. now apply inf_add. }
    assert (Q0 : 0 <= val (f * lit c_up_factor)%D) by (rewrite E; apply rnd_pos, Rmult_le_pos; lra).
    assert (T0 : 0 <= val (lit c_tiny)) by (rewrite Vt, T; lra).
    assert (0 <= rnd (val (f * lit c_up_factor)%D + val (lit c_tiny))) by (apply rnd_pos; lra).
    destruct (fadd_total _ _ G Ft) as [[H0 E']|[[E' _]|[_ A]]]; [right|left;
      exact E'|generalize (bpow_gt_0 radix2 1024); lra].
    split; [exact H0|]. rewrite E'.
    assert (Q1 : val f * cval c_up_factor * (1 - u) - eta <= val (f * lit c_up_factor)%D)
      by (rewrite E, Vu; apply rnd_lower, Rmult_le_pos; [exact P|unfold u in *; lra]).
    assert (Q2 : (val (f * lit c_up_factor)%D + val (lit c_tiny)) * (1 - u) <= rnd (val (f * lit c_up_factor)%D + val
      (lit c_tiny)))
      by (apply rnd_add_lower; try apply val_format; lra).
    apply Rle_trans with (2 := Q2). rewrite Vt, T.
    assert (Q3 : val f * (1 + 10 * u) <= val f * cval c_up_factor) by (apply Rmult_le_compat_l; [exact P|lra]).
    unfold u in *. lra.
Qed.

Lemma axis_upper c0 c1 b0 b1 c x0 x1 : lower_end c0 c -> upper_end c1 c -> lower_end b0 x0 -> upper_end b1 x1 ->
  x0 <= x1 -> 0 <= Dl x0 x1 c /\ upb (fmax (b1 - c0) (c1 - b0)) (Dl x0 x1 c * (1 - u)).
Proof.
  intros C0 C1 B0 B1 X. unfold Dl. rewrite Rmax_comm.
  assert (P : 0 <= Rmax (x1 - c) (c - x0)).
  { destruct (Rle_or_lt c x0); [apply Rle_trans with (x1 - c); [lra|apply Rmax_l]|
      apply Rle_trans with (c - x0); [lra|apply Rmax_r]]. }
  split; [exact P|]. apply hi_max; [now apply hi_sub|now apply hi_sub|exact P].
Qed.

(** Never NaN, infinite or an upper bound. *)
Theorem dl2_upper_correct c b cx cy x0 x1 y0 y1 :
  lower_end (e0 c) cx -> upper_end (e1 c) cx -> lower_end (e2 c) cy -> upper_end (e3 c) cy ->
  lower_end (e0 b) x0 -> upper_end (e1 b) x1 -> lower_end (e2 b) y0 -> upper_end (e3 b) y1 -> x0 <= x1 -> y0 <= y1 ->
  dl2_upper c b = inf \/
  (finite (dl2_upper c b) /\ Dl x0 x1 cx * Dl x0 x1 cx + Dl y0 y1 cy * Dl y0 y1 cy <= val (dl2_upper c b)).
Proof.
  intros C0 C1 C2 C3 B0 B1 B2 B3 X Y. unfold dl2_upper. cbv zeta.
  destruct (axis_upper _ _ _ _ _ _ _ C0 C1 B0 B1 X) as [Px Ux]. destruct (axis_upper _ _ _ _ _ _ _ C2 C3 B2 B3 Y) as
    [Py Uy].
  set (dx := Dl x0 x1 cx) in *. set (dy := Dl y0 y1 cy) in *.
  assert (U1 : 0 <= 1 - u) by (unfold u; lra).
  pose proof (upb_sqr _ _ (Rmult_le_pos _ _ Px U1) Ux) as Sx. pose proof (upb_sqr _ _ (Rmult_le_pos _ _ Py U1) Uy) as
    Sy.
  pose proof (upb_add _ _ _ _ Sx Sy) as S.
  assert (P : 0 <= dx * dx + dy * dy) by (generalize (Rle_0_sqr dx) (Rle_0_sqr dy); unfold Rsqr; lra).
  apply upper_correct; [exact P|].
  assert (M : (dx * dx + dy * dy) * (1 - 62 / 10 * u) - 4 * eta <=
    (dx * (1 - u) * (dx * (1 - u)) * (1 - u) - eta + (dy * (1 - u) * (dy * (1 - u)) * (1 - u) - eta)) * (1 - u)).
  { replace ((dx * (1 - u) * (dx * (1 - u)) * (1 - u) - eta + (dy * (1 - u) * (dy * (1 - u)) * (1 - u) - eta)) * (1 -
    u))
      with ((dx * dx + dy * dy) * (1 - u) ^ 4 - 2 * (1 - u) * eta) by ring.
    apply Rplus_le_compat; [apply Rmult_le_compat_l; [exact P|unfold u; lra]|generalize eta_pos; unfold u; lra]. }
  destruct S as [S|[F [Q V]]]; [left; exact S|right; split; [exact F|split; [exact Q|lra]]].
Qed.
