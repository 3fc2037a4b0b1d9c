(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* A face can be triangulated alone [LOC-1], and may keep its triangles [LOC-2]: when its rim is legal, and its
   triangles turn left and are Delaunay locally, no other representative is in their discs. The rim never winds around a
   site that was in no triangle of the face, wherever points are: so it is in none of the new triangles, either. *)
From Coq Require Import Reals Lra Lia Psatz Classical List ZArith Permutation.
From Dyadel Require Import Plane Distance Cells Legal Orientation Disc Path Fan TiedRim Winding.
Open Scope R_scope.

(* ---- how often a triangle winds around a point ---- *)

Definition around (z a b c : point) : Z := (passes z a b + passes z b c + passes z c a)%Z.

Lemma around_turned z a b c : around z b c a = around z a b c.
Proof. unfold around. lia. Qed.

Lemma passes_inside z a b : 0 <= orient a b z -> (passes z a b <= 0)%Z.
Proof.
  intros O. unfold passes. destruct (right_cases z a) as [[-> _] | [-> _]];
    destruct (right_cases z b) as [[-> _] | [-> _]]; try lia;
    match goal with |- context [Rlt_dec ?x ?y] => destruct (Rlt_dec x y) end; try lia; lra.
Qed.

Lemma around_sign z a b c : 0 < orient a b c -> (around z a b c <= 0)%Z.
Proof.
  intros D. destruct (classic (0 <= orient a b z /\ 0 <= orient b c z /\ 0 <= orient c a z)) as [[X [Y Z]] | N].
  - pose proof (passes_inside z a b X). pose proof (passes_inside z b c Y). pose proof (passes_inside z c a Z).
    unfold around. lia.
  - unfold around. rewrite (triangle_around z a b c D N). lia.
Qed.

Lemma across_x a b c z : orient a b c * fst z = orient b c z * fst a + orient c a z * fst b + orient a b z * fst c.
Proof. unfold orient. ring. Qed.

Lemma around_inside z a b c : 0 < orient a b z -> 0 < orient b c z -> 0 < orient c a z -> (around z a b c < 0)%Z.
Proof.
  intros X Y Z. pose proof (across_x a b c z) as E. pose proof (orient_sum a b c z) as S. unfold around, passes.
  destruct (Rlt_dec 0 (orient a b z)) as [_ | ?]; [| lra]. destruct (Rlt_dec 0 (orient b c z)) as [_ | ?]; [| lra].
  destruct (Rlt_dec 0 (orient c a z)) as [_ | ?]; [| lra]. destruct (Rlt_dec (orient a b z) 0) as [? | _]; [lra |].
  destruct (Rlt_dec (orient b c z) 0) as [? | _]; [lra |]. destruct (Rlt_dec (orient c a z) 0) as [? | _]; [lra |].
  destruct (right_cases z a) as [[-> A] | [-> A]]; destruct (right_cases z b) as [[-> B] | [-> B]];
    destruct (right_cases z c) as [[-> C] | [-> C]]; try lia; exfalso.
  - assert (0 <= orient b c z * (fst a - fst z)) by (apply Rmult_le_pos; lra).
    assert (0 <= orient c a z * (fst b - fst z)) by (apply Rmult_le_pos; lra).
    assert (0 <= orient a b z * (fst c - fst z)) by (apply Rmult_le_pos; lra).
    assert (T : orient b c z * (fst a - fst z) + orient c a z * (fst b - fst z) + orient a b z * (fst c - fst z) = 0)
      by (rewrite <- S in E; lra).
    assert (Ea : orient b c z * (fst a - fst z) = 0) by lra. assert (Eb : orient c a z * (fst b - fst z) = 0) by lra.
    assert (Za : fst a = fst z) by (apply Rmult_integral in Ea; lra).
    assert (Zb : fst b = fst z) by (apply Rmult_integral in Eb; lra).
    unfold orient in X. rewrite Za, Zb in X. lra.
  - assert (0 < orient b c z * (fst z - fst a)) by (apply Rmult_lt_0_compat; lra).
    assert (0 < orient c a z * (fst z - fst b)) by (apply Rmult_lt_0_compat; lra).
    assert (0 < orient a b z * (fst z - fst c)) by (apply Rmult_lt_0_compat; lra). rewrite <- S in E. lra.
Qed.

(* On the side of two triangles, not at its ends: one of the two. *)
Lemma around_side z a b c d : orient a b z = 0 -> 0 < orient b c z -> 0 < orient c a z -> 0 < orient a d z ->
  0 < orient d b z -> (around z a b c + around z b a d < 0)%Z.
Proof.
  intros O X Y U V.
  assert (O' : orient b a z = 0) by (unfold orient in *; lra). unfold around, passes. rewrite O, O'.
  destruct (Rlt_dec 0 (orient b c z)) as [_ | ?]; [| lra]. destruct (Rlt_dec 0 (orient c a z)) as [_ | ?]; [| lra].
  destruct (Rlt_dec (orient b c z) 0) as [? | _]; [lra |]. destruct (Rlt_dec (orient c a z) 0) as [? | _]; [lra |].
  destruct (Rlt_dec 0 (orient a d z)) as [_ | ?]; [| lra]. destruct (Rlt_dec 0 (orient d b z)) as [_ | ?]; [| lra].
  destruct (Rlt_dec (orient a d z) 0) as [? | _]; [lra |]. destruct (Rlt_dec (orient d b z) 0) as [? | _]; [lra |].
  destruct (Rlt_dec 0 0) as [? | _]; [lra |].
  assert (E : (orient b c z + orient c a z) * fst z = orient b c z * fst a + orient c a z * fst b).
  { pose proof (across_x a b c z) as E. pose proof (orient_sum a b c z) as S. rewrite O in *. rewrite <- S in E. lra. }
  destruct (right_cases z a) as [[-> A] | [-> A]]; destruct (right_cases z b) as [[-> B] | [-> B]].
  - assert (0 <= orient b c z * (fst a - fst z)) by (apply Rmult_le_pos; lra).
    assert (0 <= orient c a z * (fst b - fst z)) by (apply Rmult_le_pos; lra).
    assert (Ea : orient b c z * (fst a - fst z) = 0) by lra. assert (Eb : orient c a z * (fst b - fst z) = 0) by lra.
    assert (Za : fst a = fst z) by (apply Rmult_integral in Ea; lra).
    assert (Zb : fst b = fst z) by (apply Rmult_integral in Eb; lra).
    destruct (right_cases z c) as [[-> C] | [-> C]]; destruct (right_cases z d) as [[-> F] | [-> F]]; try lia. exfalso.
    assert (P : 0 < (fst c - fst z) * (snd a - snd z)) by (unfold orient in Y; rewrite Za in Y; lra).
    assert (Q : 0 < (fst d - fst z) * (snd z - snd a)) by (unfold orient in U; rewrite Za in U; lra).
    destruct (Rle_dec (snd a) (snd z)).
    + assert (0 <= (fst c - fst z) * (snd z - snd a)) by (apply Rmult_le_pos; lra). lra.
    + assert (0 <= (fst d - fst z) * (snd a - snd z)) by (apply Rmult_le_pos; lra). lra.
  - destruct (right_cases z c) as [[-> C] | [-> C]]; destruct (right_cases z d) as [[-> F] | [-> F]]; lia.
  - destruct (right_cases z c) as [[-> C] | [-> C]]; destruct (right_cases z d) as [[-> F] | [-> F]]; lia.
  - exfalso. assert (0 < orient b c z * (fst z - fst a)) by (apply Rmult_lt_0_compat; lra).
    assert (0 < orient c a z * (fst z - fst b)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

Lemma total_sides z (p : nat -> point) l : total (fun a b => passes z (p a) (p b)) (flat_map sides l) =
  fold_right (fun t s => (let '(a, b, c) := t in around z (p a) (p b) (p c) + s)%Z) 0%Z l.
Proof.
  induction l as [| [[a b] c] l IH]; [reflexivity |]. simpl flat_map. unfold total in *. simpl. rewrite IH.
  unfold around. lia.
Qed.

(* Where the rim does not wind around z, no triangle does. *)
Lemma none_around z (p : nat -> point) l E : rim_of l E ->
  (forall a b c, In (a, b, c) l -> 0 < orient (p a) (p b) (p c)) ->
  total (fun a b => passes z (p a) (p b)) E = 0%Z -> forall a b c, In (a, b, c) l -> around z (p a) (p b) (p c) = 0%Z.
Proof.
  intros R. rewrite (rim_total _ l E (fun a b => passes_back z (p a) (p b)) R), total_sides. clear R.
  induction l as [| [[x y] w] l IH]; [contradiction |]. intros D Z a b c F. simpl in Z.
  assert (N : forall k, (forall a b c, In (a, b, c) k -> 0 < orient (p a) (p b) (p c)) ->
    (fold_right (fun t s => (let '(a, b, c) := t in around z (p a) (p b) (p c) + s)%Z) 0%Z k <= 0)%Z).
  { induction k as [| [[u v] r] k IHk]; intros H; simpl; [lia |].
    specialize (IHk (fun a b c F => H a b c (or_intror F))).
    pose proof (around_sign z _ _ _ (H u v r (or_introl eq_refl))).
    lia. }
  specialize (N l (fun a b c F => D a b c (or_intror F))).
  pose proof (around_sign z _ _ _ (D x y w (or_introl eq_refl))).
  destruct F as [F | F]; [injection F as <- <- <-; lia |]. apply IH; [intros; apply D; now right | lia | exact F].
Qed.

(* ---- the face ---- *)

Section Alone.
Variables (N : nat) (B : sites) (q p : nat -> point).
Variables (Old New : list (nat * nat * nat)) (E : list (nat * nat)) (U : list triangle).
Variable before : choice N B q.
Variable now_drawn : choice N B p.
(* The rim is legal, in rectangles that hold the places before and now; its triangles were Old, now they are New. *)
Variable old_rim : rim_of Old E.
Variable new_rim : rim_of New E.
Variable legal_rim : forall a b, In (a, b) E -> (a < N)%nat /\ (b < N)%nat /\ legal N B a b.
Variable old_turns : forall a b c, In (a, b, c) Old -> 0 < orient (q a) (q b) (q c).
(* U: the new triangles with their circles, each from all three corners; beyond each side the next one, whose third
   corner is not in this one's disc. *)
Variable new_sites : forall a b c, In (a, b, c) New -> 0 < orient (p a) (p b) (p c).
Variable new_turned : forall a b c o, In (Tri a b c o) U -> In (Tri b c a o) U /\ (a < N)%nat /\
  (In (a, b, c) New \/ In (b, c, a) New \/ In (c, a, b) New) /\
  about o (p a) (p b) = 0 /\ about o (p a) (p c) = 0 /\ 0 < orient (p a) (p b) (p c).
Variable new_sides : forall a b c o, In (Tri a b c o) U ->
  In (a, b) E \/ exists l w, In (Tri b a l w) U /\ 0 <= about o (p a) (p l).

Theorem face_alone m : (m < N)%nat ->
  (forall a b c, In (a, b, c) Old -> ~ (0 <= orient (q a) (q b) (q m) /\ 0 <= orient (q b) (q c) (q m) /\
    0 <= orient (q c) (q a) (q m))) ->
  (forall a b, In (a, b) E -> m <> a /\ m <> b) -> (forall a b c o, In (Tri a b c o) U -> p m <> p a) ->
  forall a b c o, In (Tri a b c o) U -> 0 <= about o (p a) (p m).
Proof.
  intros M Out Off Apart x y w v F. apply Rnot_lt_le. intros Bad.
  assert (W0 : total (fun a b => passes (p m) (p a) (p b)) E = 0%Z).
  { assert (C : forall k, continuity (fun s => fst (path q p s k)) /\ continuity (fun s => snd (path q p s k)))
      by (intros k; unfold path, mix; simpl; split; reg).
    pose proof (winding_steady E (fun k s => path q p s k) (fun s => path q p s m)
      (rim_closed _ _ old_rim) C (C m)) as W.
    cbv beta in W. rewrite path_0, path_1 in W.
    rewrite (total_same (fun a b => passes (p m) (p a) (p b)) (fun a b => passes (p m) (path q p 1 a) (path q p 1 b)))
      by (intros; now rewrite !path_1).
    rewrite W.
    - rewrite (total_same _ (fun a b => passes (q m) (q a) (q b))) by (intros; now rewrite !path_0).
      apply (rim_around Old E q (q m) old_rim). intros a b c G. split; [now apply old_turns | now apply Out].
    - intros t a b T G. destruct (legal_rim a b G) as [A [H Le]]. destruct (Off a b G) as [Ma Mb].
      apply (edge_is_free N (path q p t)); auto. apply (legal_sound N B); auto. now apply path_choice. }
  assert (None : forall a b c o, In (Tri a b c o) U -> around (p m) (p a) (p b) (p c) = 0%Z).
  { intros a b c o G. pose proof (none_around (p m) p New E new_rim new_sites W0) as Z.
    destruct (new_turned _ _ _ _ G) as [_ [_ [[K | [K | K]] _]]]; specialize (Z _ _ _ K).
    - exact Z.
    - now rewrite around_turned in Z.
    - rewrite 2!around_turned in Z. exact Z. }
  destruct (walk p U (p m) (fun _ _ => False)) as [[[a b c o] [G [_ I]]] | [a [b []]]].
  - intros a b c o G. pose proof (new_turned _ _ _ _ G). tauto.
  - intros a b c o G L Z. left. destruct (new_sides _ _ _ _ G) as [S | S]; [exfalso | exact S].
    destruct (new_turned _ _ _ _ G) as [G1 [La [_ [Eb [Ec D]]]]]. destruct (new_turned _ _ _ _ G1) as [G2 [Lb _]].
    destruct (new_turned _ _ _ _ G2) as [_ [Lc _]]. destruct (legal_rim a b S) as [_ [_ Le]].
    destruct (Off a b S) as [Ma Mb].
    assert (Dab : p a <> p b) by (intros X; unfold orient in D; rewrite X in D; lra).
    destruct (legal_sound N B a b p La Lb Le now_drawn) as [h [Eq Far]].
    assert (Hb : about h (p a) (p b) = 0) by (apply dist_eq in Eq; unfold about; lra).
    assert (Ca : c <> a) by (intros ->; unfold orient in D; lra).
    assert (Cb : c <> b) by (intros ->; unfold orient in D; lra).
    destruct (pencil o h (p a) (p b) Dab Eb Hb) as [k K].
    pose proof (Far c Lc Ca Cb) as Fc. pose proof (Far m M Ma Mb) as Fm. apply dist_lt in Fc, Fm.
    assert (Kc : 0 < about h (p a) (p c)) by (unfold about; lra).
    assert (Km : 0 < about h (p a) (p m)) by (unfold about; lra).
    rewrite K, Ec in Kc. rewrite K in Km. assert (0 < k) by (apply (Rmult_lt_reg_r (orient (p a) (p b) (p c))); lra).
    assert (0 < k * - orient (p a) (p b) (p m)) by (apply Rmult_lt_0_compat; lra). lra.
  - exists (Tri x y w v). now split.
  - destruct I as [X [Y Z]]. simpl in X, Y, Z.
    assert (Side : forall a b c o, In (Tri a b c o) U -> orient (p a) (p b) (p m) = 0 ->
      0 <= orient (p b) (p c) (p m) -> 0 <= orient (p c) (p a) (p m) -> False).
    { clear - new_turned new_sides legal_rim now_drawn Off Apart M None. intros a b c o G O Y Z.
      destruct (new_turned _ _ _ _ G) as [G1 [La [_ [_ [_ D]]]]]. destruct (new_turned _ _ _ _ G1) as [G2 [Lb _]].
      pose proof (orient_sum (p a) (p b) (p c) (p m)) as S. pose proof (across_x (p a) (p b) (p c) (p m)) as Ex.
      assert (Ey : orient (p a) (p b) (p c) * snd (p m) = orient (p b) (p c) (p m) * snd (p a) +
        orient (p c) (p a) (p m) * snd (p b) + orient (p a) (p b) (p m) * snd (p c)) by (unfold orient; ring).
      rewrite O in S, Ex, Ey.
      assert (Y0 : orient (p b) (p c) (p m) <> 0).
      { intros Q. apply (Apart _ _ _ _ G1). apply (scaled_point_eq (orient (p a) (p b) (p c))); [lra | |];
          [rewrite Ex | rewrite Ey]; rewrite Q in *; rewrite <- S; ring. }
      assert (Z0 : orient (p c) (p a) (p m) <> 0).
      { intros Q. apply (Apart _ _ _ _ G). apply (scaled_point_eq (orient (p a) (p b) (p c))); [lra | |];
          [rewrite Ex | rewrite Ey]; rewrite Q in *; rewrite <- S; ring. }
      destruct (new_sides _ _ _ _ G) as [Rm | [l [h [G' _]]]].
      - destruct (legal_rim a b Rm) as [_ [_ Le]]. destruct (Off a b Rm) as [Ma Mb].
        apply (edge_is_free N p a b m M Ma Mb (legal_sound N B a b p La Lb Le now_drawn)).
        exists (orient (p c) (p a) (p m) / orient (p a) (p b) (p c)). split.
        + split; [apply Rmult_le_pos; [lra | left; apply Rinv_0_lt_compat; lra] |].
          apply (Rmult_le_reg_r (orient (p a) (p b) (p c))); [lra |]. unfold Rdiv.
          rewrite Rmult_assoc, Rinv_l by lra. lra.
        + set (t := orient (p c) (p a) (p m) / orient (p a) (p b) (p c)).
          assert (T : orient (p a) (p b) (p c) * t = orient (p c) (p a) (p m)) by (unfold t; field; lra).
          apply (scaled_point_eq (orient (p a) (p b) (p c))); [lra | |]; unfold mix; simpl.
          * transitivity (orient (p a) (p b) (p c) * fst (p a) +
              orient (p a) (p b) (p c) * t * (fst (p b) - fst (p a)));
              [rewrite T, Ex, <- S; ring | ring].
          * transitivity (orient (p a) (p b) (p c) * snd (p a) +
              orient (p a) (p b) (p c) * t * (snd (p b) - snd (p a)));
              [rewrite T, Ey, <- S; ring | ring].
      - destruct (new_turned _ _ _ _ G') as [_ [_ [_ [_ [_ D']]]]].
        pose proof (None _ _ _ _ G) as Z1. pose proof (None _ _ _ _ G') as Z2.
        assert (K : (around (p m) (p a) (p b) (p c) + around (p m) (p b) (p a) (p l) < 0)%Z); [| lia].
        assert (E1 : orient (p a) (p b) (p c) * orient (p a) (p l) (p m) =
          orient (p c) (p a) (p m) * orient (p b) (p a) (p l) + orient (p a) (p b) (p m) * orient (p a) (p l) (p c))
          by (unfold orient; ring).
        assert (E2 : orient (p a) (p b) (p c) * orient (p l) (p b) (p m) =
          orient (p b) (p c) (p m) * orient (p b) (p a) (p l) + orient (p a) (p b) (p m) * orient (p l) (p b) (p c))
          by (unfold orient; ring).
        rewrite O in E1, E2.
        assert (0 < orient (p c) (p a) (p m) * orient (p b) (p a) (p l)) by (apply Rmult_lt_0_compat; lra).
        assert (0 < orient (p b) (p c) (p m) * orient (p b) (p a) (p l)) by (apply Rmult_lt_0_compat; lra).
        apply around_side; [exact O | lra | lra | |];
          apply (Rmult_lt_reg_l (orient (p a) (p b) (p c))); lra. }
    destruct (new_turned _ _ _ _ G) as [G1 _]. destruct (new_turned _ _ _ _ G1) as [G2 _].
    destruct (Req_dec (orient (p a) (p b) (p m)) 0) as [O | O]; [now apply (Side _ _ _ _ G) |].
    destruct (Req_dec (orient (p b) (p c) (p m)) 0) as [O1 | O1]; [now apply (Side _ _ _ _ G1) |].
    destruct (Req_dec (orient (p c) (p a) (p m)) 0) as [O2 | O2]; [now apply (Side _ _ _ _ G2) |].
    pose proof (around_inside (p m) (p a) (p b) (p c)) as K. rewrite (None _ _ _ _ G) in K.
    assert (0 < 0)%Z; [apply K; lra | lia].
Qed.
End Alone.
