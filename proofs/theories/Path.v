(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Tools for moving along a path: open and closed sets of times, and which of three collinear points is between. *)
From Coq Require Import Reals Lra Psatz Classical List.
From Dyadel Require Import Plane Orientation.
Open Scope R_scope.

(* A set of numbers that is open and closed in [0,1] and has 0 has 1. *)
Lemma open_closed (P : R -> Prop) : P 0 ->
  (forall t, 0 <= t <= 1 -> P t -> exists e, 0 < e /\ forall s, Rabs (s - t) <= e -> 0 <= s <= 1 -> P s) ->
  (forall t, 0 <= t <= 1 -> ~ P t -> exists e, 0 < e /\ forall s, Rabs (s - t) <= e -> 0 <= s <= 1 -> ~ P s) ->
  P 1.
Proof.
  intros P0 Op Cl. set (E t := 0 <= t <= 1 /\ forall s, 0 <= s <= t -> P s).
  destruct (completeness E) as [m [Ub Lub]].
  - exists 1. intros t [T _]. lra.
  - exists 0. split; [lra |]. intros s S. replace s with 0 by lra. exact P0.
  - assert (M : 0 <= m <= 1).
    { split; [apply Ub; split; [lra |]; intros s S; replace s with 0 by lra; exact P0 |].
      apply Lub. intros t [T _]. lra. }
    assert (Below : forall s, 0 <= s < m -> P s).
    { intros s S. apply NNPP. intros N. assert (m <= s); [| lra]. apply Lub. intros t [T H].
      apply Rnot_lt_le. intros L. apply N, H. lra. }
    assert (Pm : P m).
    { apply NNPP. intros N. destruct (Cl m M N) as [e [E0 H]].
      destruct (Req_dec m 0) as [Z | Z]; [now rewrite Z in N |].
      set (s := Rmax 0 (m - e / 2)). assert (S : 0 <= s < m).
      { split; [apply Rmax_l |]. unfold s. apply Rmax_lub_lt; lra. }
      apply (H s); [| lra | now apply Below]. rewrite Rabs_minus_sym, Rabs_pos_eq by lra.
      pose proof (Rmax_r 0 (m - e / 2)) as X. fold s in X. lra. }
    destruct (Req_dec m 1) as [<- | D]; [exact Pm |]. exfalso.
    destruct (Op m M Pm) as [e [E0 H]]. set (d := Rmin e (1 - m)).
    assert (D0 : 0 < d) by (apply Rmin_pos; lra).
    assert (D1 : d <= e) by apply Rmin_l. assert (D2 : d <= 1 - m) by apply Rmin_r.
    assert (E (m + d)).
    { split; [lra |]. intros s S. destruct (Rlt_dec s m) as [L | L]; [apply Below; lra |].
      apply H; [rewrite Rabs_pos_eq; lra | lra]. }
    pose proof (Ub (m + d) ltac:(assumption)). lra.
Qed.

Definition near (t : R) (P : R -> Prop) : Prop := exists e, 0 < e /\ forall s, Rabs (s - t) <= e -> P s.

Lemma near_and t P Q : near t P -> near t Q -> near t (fun s => P s /\ Q s).
Proof.
  intros [e [E H]] [f [F G]]. exists (Rmin e f). split; [now apply Rmin_pos |]. intros s S.
  pose proof (Rmin_l e f). pose proof (Rmin_r e f). split; [apply H | apply G]; lra.
Qed.

Lemma near_weaken t (P Q : R -> Prop) : (forall s, P s -> Q s) -> near t P -> near t Q.
Proof. intros I [e [E H]]. exists e. split; [exact E |]. intros s S. now apply I, H. Qed.

Lemma near_list {A} t (P : A -> R -> Prop) l : (forall x, In x l -> near t (P x)) ->
  near t (fun s => forall x, In x l -> P x s).
Proof.
  induction l as [| y l IH]; intros H.
  - exists 1. split; [lra |]. intros s _ x [].
  - assert (G : near t (fun s => P y s /\ forall x, In x l -> P x s)).
    { apply near_and; [apply H; now left | apply IH; intros x X; apply H; now right]. }
    revert G. apply near_weaken. intros s [Y L] x [<- | X]; [exact Y | now apply L].
Qed.

Lemma near_positive f t : continuity f -> 0 < f t -> near t (fun s => 0 < f s).
Proof.
  intros K H. destruct (K t (f t) H) as [e [E G]]. exists (e / 2). split; [lra |]. intros s S.
  destruct (Req_dec s t) as [-> | D]; [exact H |].
  assert (X : Rabs (f s - f t) < f t).
  { apply G. split; [split; [exact Logic.I | now apply not_eq_sym] |]. simpl. unfold R_dist. lra. }
  apply Rabs_def2 in X. lra.
Qed.

Lemma near_negative f t : continuity f -> f t < 0 -> near t (fun s => f s < 0).
Proof.
  intros K H. destruct (near_positive (fun s => - f s) t) as [e [E G]].
  - now apply (continuity_opp f).
  - lra.
  - exists e. split; [exact E |]. intros s S. specialize (G s S). simpl in G. lra.
Qed.

(* Collinear points: one is between the two others. *)
Lemma one_between x y z : orient x y z = 0 -> between x y z \/ between y x z \/ between z x y.
Proof.
  intros H. destruct (classic (x = y)) as [<- | D].
  - left. exists 0. split; [lra |]. now rewrite mix_0.
  - set (q := dist2 x y). assert (Q : 0 < q) by (unfold q; rewrite <- dist_sq; pose proof (dist_pos x y D); nra).
    set (k := ((fst y - fst x) * (fst z - fst x) + (snd y - snd x) * (snd z - snd x)) / q).
    assert (Zx : fst z = fst x + k * (fst y - fst x)).
    { apply (Rmult_eq_reg_l q); [| lra]. unfold k.
      replace (q * (fst x + _ / q * (fst y - fst x)))
        with (q * fst x + ((fst y - fst x) * (fst z - fst x) + (snd y - snd x) * (snd z - snd x)) * (fst y - fst x))
        by (field; lra).
      apply Rminus_diag_uniq. transitivity (- (snd y - snd x) * orient x y z);
        [unfold q, dist2, orient; ring | rewrite H; ring]. }
    assert (Zy : snd z = snd x + k * (snd y - snd x)).
    { apply (Rmult_eq_reg_l q); [| lra]. unfold k.
      replace (q * (snd x + _ / q * (snd y - snd x)))
        with (q * snd x + ((fst y - fst x) * (fst z - fst x) + (snd y - snd x) * (snd z - snd x)) * (snd y - snd x))
        by (field; lra).
      apply Rminus_diag_uniq. transitivity ((fst y - fst x) * orient x y z);
        [unfold q, dist2, orient; ring | rewrite H; ring]. }
    destruct (Rlt_dec k 0) as [K | K]; [| destruct (Rle_dec k 1) as [K' | K']].
    + left. exists (/ (1 - k)). assert (I : 0 < / (1 - k)) by (apply Rinv_0_lt_compat; lra). split.
      * split; [lra |]. apply (Rmult_le_reg_r (1 - k)); [lra |]. rewrite Rinv_l; lra.
      * destruct x, y, z. unfold mix. simpl in *. rewrite Zx, Zy. f_equal; field; lra.
    + right. right. exists k. split; [lra |]. destruct x, y, z. unfold mix. simpl in *. rewrite Zx, Zy. f_equal; ring.
    + right. left. exists (/ k). assert (I : 0 < / k) by (apply Rinv_0_lt_compat; lra). split.
      * split; [lra |]. apply (Rmult_le_reg_r k); [lra |]. rewrite Rinv_l; lra.
      * destruct x, y, z. unfold mix. simpl in *. rewrite Zx, Zy. f_equal; field; lra.
Qed.
